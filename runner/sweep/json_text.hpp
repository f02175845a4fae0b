// Strict reading of a JSON file: every refusal says where and what to change.
//
// The parser underneath keeps the last of two equal keys, accepts any depth and then crashes on
// copying it, and reports positions only for syntax; hence the checks before and after it here.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "runner/sweep/problem.hpp"

namespace grainsweep {

/// JSON that keeps the order of keys: the order of a grid's lists is the order of its jobs.
using Json = nlohmann::ordered_json;

/// Brackets inside brackets; a sweep needs fewer than ten.
inline constexpr int deepest_json = 32;

/// A file's bytes, or why there are none.
struct FileText {
  std::string text;
  std::vector<Finding> errors;  ///< at most one
};

/// Reads a whole file of at most 256 MiB. Refuses what is missing, unreadable, a folder or empty.
FileText read_text(const std::string& path);

struct JsonReading {
  Json value;  ///< meaningful only if `errors` is empty
  std::vector<Finding> errors;
};

/// Parses `text`, the content of `file`. Refuses malformed JSON, NaN and Infinity, text that is not
/// UTF-8, numbers beyond f64, more than `deepest_json` levels and two equal keys in one object.
JsonReading parse_strictly(const std::string& text, const std::string& file);

}  // namespace grainsweep
