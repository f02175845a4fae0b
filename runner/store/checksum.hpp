// CRC-32 (ISO 3309, as in zip and png) of stored bytes: tells a torn or damaged record from a whole
// one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runner/store/bytes.hpp"

namespace grainsweep {

/// table[k][b]: the remainder of byte b with k zero bytes behind it, modulo the reflected
/// polynomial 0xEDB88320.
constexpr std::array<std::array<std::uint32_t, 256>, 8> crc32_tables() {
  std::array<std::array<std::uint32_t, 256>, 8> table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (auto& remainders : table) {
      for (int bit = 0; bit < 8; ++bit) {
        remainder = (remainder >> 1) ^ ((remainder & 1u) != 0 ? 0xEDB88320u : 0u);
      }
      remainders[byte] = remainder;
    }
  }
  return table;
}

/// crc32("123456789") is 0xCBF43926. Eight bytes at a time, whose remainders do not wait for each
/// other: a journal of many thousand packings is read as fast as the disk gives it.
inline std::uint32_t crc32(std::string_view bytes) {
  static constexpr auto tables = crc32_tables();
  std::uint32_t sum = 0xFFFFFFFFu;
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      next ^= tables[7 - i][at(i) ^ ((sum >> (8 * i)) & 0xFFu)] ^ tables[3 - i][at(i + 4)];
    }
    sum = next;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    sum = tables[0][(sum ^ at(i)) & 0xFFu] ^ (sum >> 8);
  }
  return ~sum;
}

inline constexpr std::size_t checksum_size = sizeof(std::uint32_t);

/// The last bytes, as put() appends a checksum, are the checksum of all before them.
inline bool ends_in_its_checksum(std::string_view bytes) {
  if (bytes.size() < checksum_size) return false;
  std::string_view end = bytes.substr(bytes.size() - checksum_size);
  return take<std::uint32_t>(end) == crc32(bytes.substr(0, bytes.size() - checksum_size));
}

}  // namespace grainsweep
