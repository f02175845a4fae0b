// What is wrong with a sweep: where, what, and what to change.
//
// The parts of the reader know JSON pointers only; lines and columns are looked up once, at the
// end, for all diagnostics together (json_text.hpp). What is wrong with another file, or with the
// text itself, has its place from the beginning.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// Which end of an object's member a diagnostic is about: its key or its value.
enum class Anchor { value, key };

/// One thing wrong with the input.
struct Diagnostic {
  std::string pointer;  ///< JSON pointer into the sweep file, "/base/box/width"; "" for none
  std::string message;  ///< what must hold, what was found: "must lie in [0, 1], is 1.4"
  Anchor anchor = Anchor::value;
  std::string place = {};  ///< "spheres.json:12:20", or the file alone; "" until it is looked up
  bool is_note = false;    ///< worth knowing; the sweep can be run as it is
};
using Diagnostics = std::vector<Diagnostic>;

/// Whether any of them is more than a note.
bool has_errors(const Diagnostics& diagnostics);

/// "spheres.json:12:20 /base/sizes/small_share: must lie in [0, 1], is 1.4"; control characters
/// become question marks.
std::string to_string(const Diagnostic& diagnostic);

/// `pointer` extended by one key or index, with ~ and / escaped (RFC 6901).
std::string child_pointer(const std::string& pointer, std::string_view key);

}  // namespace grainsweep
