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

/// Bit by bit, as the standard defines it.
std::uint32_t crc32_by_bits(const std::string& bytes) {
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~sum;
}

TEST_CASE("the checksum of any text equals the one taken bit by bit") {
  std::string text;
  for (int size = 0; size < 100; ++size) {
    CHECK(crc32(text) == crc32_by_bits(text));
    text += static_cast<char>(size * 89 + 200);
  }
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
