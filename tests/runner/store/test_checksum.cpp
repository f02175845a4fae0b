#include <string>

#include <catch2/catch.hpp>

#include "runner/store/checksum.hpp"

namespace grainsweep {
namespace {

TEST_CASE("the checksum is CRC-32 as others compute it") {
  CHECK(crc32("") == 0u);
  CHECK(crc32("123456789") == 0xCBF43926u);
  CHECK(crc32("The quick brown fox jumps over the lazy dog") == 0x414FA339u);
}

TEST_CASE("every single flipped bit changes the checksum") {
  const std::string text = "{\"job\":\"0123456789abcdef\"}";
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string flipped = text;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    CHECK(crc32(flipped) != crc32(text));
  }
}

}  // namespace
}  // namespace grainsweep
