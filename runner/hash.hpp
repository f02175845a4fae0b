// Hashes of bytes, which identify jobs and tell damaged records from whole ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <zlib.h>

namespace grainsweep {

/// FNV-1a, 64 bits; `hash` is that of the bytes before these.
inline std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = 0xcbf29ce484222325) {
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  }
  return hash;
}

/// Finaliser of SplitMix64: a bijection of 64 bits in which every input bit moves every output bit.
inline std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31U);
}

/// CRC-32 (ISO 3309, as in zip and png); crc32("123456789") is 0xCBF43926.
inline std::uint32_t crc32(std::string_view bytes) {
  const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
  return static_cast<std::uint32_t>(::crc32_z(0, first, bytes.size()));
}

/// Lower-case hex digits, the highest first.
inline std::string hex(std::uint64_t bits, std::size_t digits) {
  std::string text(digits, '0');
  for (std::size_t i = digits; i-- > 0; bits >>= 4U) text[i] = "0123456789abcdef"[bits & 15U];
  return text;
}
inline std::string hex16(std::uint64_t bits) { return hex(bits, 16); }
inline std::string hex8(std::uint32_t bits) { return hex(bits, 8); }

}  // namespace grainsweep
