#include <string>

#include <catch2/catch.hpp>

#include "runner/hash.hpp"

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

TEST_CASE("FNV-1a gives its published values") {
  CHECK(fnv1a("") == 0xcbf29ce484222325);
  CHECK(fnv1a("a") == 0xaf63dc4c8601ec8c);
  CHECK(fnv1a("foobar") == 0x85944171f73967e8);
}

TEST_CASE("hex digits have a fixed number") {
  CHECK(hex16(0) == "0000000000000000");
  CHECK(hex16(0x0123456789abcdef) == "0123456789abcdef");
  CHECK(hex8(0xa0b1) == "0000a0b1");
}

}  // namespace
}  // namespace grainsweep
