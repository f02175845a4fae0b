// CRC-32 (ISO 3309, as in zip and png) of stored bytes: tells a torn or damaged record from a whole
// one.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace grainsweep {

/// The 256 remainders of the reflected polynomial 0xEDB88320.
constexpr std::array<std::uint32_t, 256> crc32_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit) {
      remainder = (remainder >> 1) ^ ((remainder & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    table[byte] = remainder;
  }
  return table;
}

/// crc32("123456789") is 0xCBF43926.
constexpr std::uint32_t crc32(std::string_view bytes) {
  constexpr auto table = crc32_table();
  std::uint32_t sum = 0xFFFFFFFFu;
  for (const char byte : bytes) {
    sum = table[(sum ^ static_cast<unsigned char>(byte)) & 0xFFu] ^ (sum >> 8);
  }
  return ~sum;
}

}  // namespace grainsweep
