// Values as little-endian bytes, and back: what the binary files of an output folder hold.
//
// A struct takes part by one list of its members, which serves both ways:
//   constexpr auto members_of(const Grain*) { return std::tuple(&Grain::x, &Grain::y); }
// Numbers are stored as they are, enums as their numbers, bools in a byte; strings and vectors as a
// u64 of their length and their elements, an optional as a bool and its value if it has one.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "runner/hash.hpp"

namespace grainsweep {

static_assert(std::endian::native == std::endian::little, "bytes are taken as they are in memory");

template <class Number>
concept Plain = std::is_arithmetic_v<Number> || std::is_enum_v<Number>;

/// Appends values to bytes.
class ByteWriter {
 public:
  template <Plain Number>
  void put(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class Item>
  void put(const std::vector<Item>& items) {
    put(static_cast<std::uint64_t>(items.size()));
    for (const Item& item : items) put(item);
  }
  template <class Item, std::size_t size>
  void put(const std::array<Item, size>& items) {
    for (const Item& item : items) put(item);
  }
  template <class Value>
  void put(const std::optional<Value>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class Struct>
  requires std::is_class_v<Struct>
  void put(const Struct& value) {
    std::apply([&](auto... member) { (put(value.*member), ...); }, members_of(&value));
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes values off the front of bytes. Throws std::length_error if they end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <Plain Number>
  void take(Number& value) {
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
  }
  void take(bool& value) { value = next(1).front() != 0; }
  void take(std::string& text) { text = next(take_size()); }
  template <class Item>
  void take(std::vector<Item>& items) {
    items.clear();
    items.resize(take_size());
    for (Item& item : items) take(item);
  }
  template <class Item, std::size_t size>
  void take(std::array<Item, size>& items) {
    for (Item& item : items) take(item);
  }
  template <class Value>
  void take(std::optional<Value>& value) {
    bool has_value = false;
    take(has_value);
    value.reset();
    if (has_value) take(value.emplace());
  }
  template <class Struct>
  requires std::is_class_v<Struct>
  void take(Struct& value) {
    std::apply([&](auto... member) { (take(value.*member), ...); }, members_of(&value));
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view next(std::size_t size) {
    if (size > bytes_.size()) throw std::length_error("stored bytes end too early");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  /// A number of elements, of a byte or more each.
  std::size_t take_size() {
    std::uint64_t size = 0;
    take(size);
    if (size > bytes_.size()) throw std::length_error("stored bytes end too early");
    return size;
  }

  std::string_view bytes_;
};

/// The bytes of a file: `mark`, the value, and the CRC-32 of all before.
template <class Value>
std::string file_bytes(std::string_view mark, const Value& value) {
  ByteWriter writer;
  writer.bytes() = mark;
  writer.put(value);
  writer.put(crc32(writer.bytes()));
  return std::move(writer.bytes());
}

/// The value in the bytes of a file; nothing if they are not what file_bytes gave for such a value.
template <class Value>
std::optional<Value> value_in_file(std::string_view mark, std::string_view bytes) {
  constexpr std::size_t checksum_size = sizeof(std::uint32_t);
  if (!bytes.starts_with(mark) || bytes.size() < mark.size() + checksum_size) return std::nullopt;
  const std::string_view checked = bytes.substr(0, bytes.size() - checksum_size);
  std::uint32_t checksum = 0;
  ByteReader(bytes.substr(checked.size())).take(checksum);
  if (checksum != crc32(checked)) return std::nullopt;
  ByteReader reader(checked.substr(mark.size()));
  try {
    std::optional<Value> value(std::in_place);
    reader.take(*value);
    return reader.is_at_end() ? std::move(value) : std::nullopt;
  } catch (const std::length_error&) {
    return std::nullopt;  // whole, but another form of the value
  }
}

}  // namespace grainsweep
