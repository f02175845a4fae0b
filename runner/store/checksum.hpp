// CRC-32 (ISO 3309, as in zip and png) of stored bytes: tells a torn or damaged record from a whole
// one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <libdeflate.h>
#include <string_view>

#include "runner/store/bytes.hpp"

namespace grainsweep {

/// crc32("123456789") is 0xCBF43926.
inline std::uint32_t crc32(std::string_view bytes) {
  return libdeflate_crc32(0, bytes.data(), bytes.size());
}

inline constexpr std::size_t checksum_size = sizeof(std::uint32_t);

/// The last bytes, as put() appends a checksum, are the checksum of all before them.
inline bool ends_in_its_checksum(std::string_view bytes) {
  if (bytes.size() < checksum_size) return false;
  std::string_view end = bytes.substr(bytes.size() - checksum_size);
  return take<std::uint32_t>(end) == crc32(bytes.substr(0, bytes.size() - checksum_size));
}

}  // namespace grainsweep
