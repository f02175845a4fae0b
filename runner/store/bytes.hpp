// Numbers as little-endian bytes, as the binary files of an output folder hold them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace grainsweep {

/// Appends an unsigned number, lowest byte first.
template <class Unsigned>
void put(std::string& bytes, Unsigned value) {
  for (std::size_t byte = 0; byte < sizeof value; ++byte) {
    bytes.push_back(static_cast<char>((value >> (8 * byte)) & 0xFFu));
  }
}

/// Appends the bits of a double.
inline void put(std::string& bytes, double value) {
  put(bytes, std::bit_cast<std::uint64_t>(value));
}

/// Appends the length of a text, u64, and the text.
inline void put_text(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint64_t>(text.size()));
  bytes.append(text);
}

/// Throws std::length_error if fewer bytes follow than `count` items take.
inline void need(std::string_view bytes, std::uint64_t count, std::size_t item_size) {
  if (count > bytes.size() / item_size) throw std::length_error("stored bytes end too early");
}

/// Takes a number off the front of bytes known to be long enough.
template <class Unsigned>
Unsigned take(std::string_view& bytes) {
  Unsigned value = 0;
  for (std::size_t byte = 0; byte < sizeof value; ++byte) {
    const auto next = static_cast<Unsigned>(static_cast<unsigned char>(bytes[byte]));
    value = static_cast<Unsigned>(value | static_cast<Unsigned>(next << (8 * byte)));
  }
  bytes.remove_prefix(sizeof value);
  return value;
}

inline double take_double(std::string_view& bytes) {
  return std::bit_cast<double>(take<std::uint64_t>(bytes));
}

/// Takes what put_text appended.
inline std::string take_text(std::string_view& bytes) {
  const auto size = take<std::uint64_t>(bytes);
  std::string text(bytes.substr(0, size));
  bytes.remove_prefix(text.size());
  return text;
}

}  // namespace grainsweep
