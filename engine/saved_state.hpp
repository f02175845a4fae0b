// A state as bytes, so that a packing that was interrupted goes on with the same bits.
//
// One function per type lists its members; it writes them through a StateWriter or reads them back
// through a StateReader. The bytes are for the program that wrote them: a header tells whether they
// are of this format, this kind of state, and whole.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace grainsweep {

/// Appends values to bytes.
class StateWriter {
 public:
  template <class T>
  void value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  /// A vector, or a string.
  template <class Column>
  void column(const Column& column) {
    using T = typename Column::value_type;
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(column.size()));
    bytes_.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(T));
  }
  /// Calls each(element) after the number of elements.
  template <class T, class Each>
  void list(const std::vector<T>& elements, Each each) {
    value(static_cast<std::uint64_t>(elements.size()));
    for (const T& element : elements) {
      each(element);
    }
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads values in the order in which they were written. Throws std::length_error if the bytes end
/// too early, as those of another state do.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void value(T& value) {
    take(&value, sizeof(T));
  }
  template <class Column>
  void column(Column& column) {
    constexpr std::size_t bytes_each = sizeof(typename Column::value_type);
    column.resize(take_size(bytes_each));
    take(column.data(), column.size() * bytes_each);
  }
  template <class T, class Each>
  void list(std::vector<T>& elements, Each each) {
    elements.resize(take_size(1));
    for (T& element : elements) {
      each(element);
    }
  }

 private:
  void take(void* to, std::size_t size) {
    expect(size, 1);
    if (size > 0) {
      std::memcpy(to, bytes_.data(), size);
    }
    bytes_.remove_prefix(size);
  }
  /// The size of a list whose elements have so many bytes each, or more.
  std::uint64_t take_size(std::size_t bytes_each) {
    std::uint64_t size = 0;
    value(size);
    expect(size, bytes_each);
    return size;
  }
  void expect(std::uint64_t count, std::size_t bytes_each) const {
    if (count > bytes_.size() / bytes_each) {
      throw std::length_error("the saved state of the packing ends too early");
    }
  }

  std::string_view bytes_;
};

/// `payload` with a header; `kind` tells states apart that must not be taken for each other.
std::string sealed(std::uint64_t kind, std::string_view payload);

/// The payload of sealed bytes, which must outlive it; nothing if they are torn, changed, of
/// another format or kind.
std::optional<std::string_view> unsealed(std::uint64_t kind, std::string_view bytes);

}  // namespace grainsweep
