// Where the values of a JSON text are written: lines and columns, which parsers forget.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace grainsweep {

/// One value of a JSON text. Offsets are bytes from the start of the text.
struct JsonPlace {
  const std::string& pointer;  ///< e.g. "/sweep/0/grid/box.width/2"
  bool is_member;              ///< member of an object (true) or entry of a list, or the root
  std::size_t key;             ///< start of the member's key; of the value where there is no key
  std::size_t value;           ///< start of the value
};

/// Calls `visit` for every value of `text` in the order of the text, in one pass.
/// Requires valid JSON no deeper than `deepest_json` (runner/sweep/json_text.hpp).
void for_each_value(const std::string& text, const std::function<void(const JsonPlace&)>& visit);

/// Line and column of byte offsets in a text. Lines and columns count from 1, columns in characters
/// (not bytes) of UTF-8, as editors do.
class LineIndex {
 public:
  explicit LineIndex(const std::string& text);

  /// ":line:column" of the byte at `offset`; the end of the text is allowed.
  std::string place(std::size_t offset) const;

 private:
  std::size_t size_;
  std::vector<std::size_t> starts_;         // offset of every line's first byte
  std::vector<std::size_t> continuations_;  // offsets of bytes that continue a character
};

}  // namespace grainsweep
