// What is wrong with a sweep, while it is still being read: by JSON pointer, without lines.
//
// The parts of the reader only know pointers; lines and columns are looked up once, at the end, for
// all problems together.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grainsweep {

/// Which end of an object's member a problem is about: its key or its value.
enum class Anchor { value, key };

struct Problem {
  std::string pointer;  ///< JSON pointer into the sweep file, e.g. "/base/box/width"
  std::string message;  ///< what must hold, what was found
  Anchor anchor = Anchor::value;
  std::string elsewhere =
      {};  ///< place in another file, "bed.csv:12"; "" for the sweep file itself
};
using Problems = std::vector<Problem>;

/// `pointer` extended by one key or index, with ~ and / escaped (RFC 6901).
std::string child_pointer(const std::string& pointer, std::string_view key);

/// One thing wrong with the input: where, what, and what to change.
struct Finding {
  std::string place;    ///< "spheres.json:12:20", or the file alone where there is no line
  std::string pointer;  ///< JSON pointer of the value, "" where there is none
  std::string message;  ///< "must lie in [0, 1], is 1.4"
};

/// "spheres.json:12:20 /base/sizes/small_share: must lie in [0, 1], is 1.4"; control characters
/// become question marks.
std::string to_string(const Finding& finding);

/// The problems with their lines and columns in `text`, the content of `file` (valid JSON), in the
/// order of the file and without repeats. A pointer that is not there takes the place of the
/// nearest part of it that is.
std::vector<Finding> findings_of(const Problems& problems, const std::string& text,
                                 const std::string& file);

}  // namespace grainsweep
