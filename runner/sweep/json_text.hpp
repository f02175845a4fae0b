// Strict reading of JSON: one pass gives the values, the place of each, and what is wrong.
//
// The parser underneath keeps the last of two equal keys, takes any depth and then crashes on
// copying it, and forgets where values are written; hence a handler of its events here, which reads
// along where the parser is in the text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

/// JSON that keeps the order of keys: the order of a grid's lists is the order of its jobs.
using Json = nlohmann::ordered_json;

/// Brackets inside brackets; a sweep needs fewer than ten.
inline constexpr int deepest_json = 32;

/// Where a value is written, as offsets of bytes; a file is far shorter than 4 GiB.
struct JsonPlace {
  std::uint32_t key = 0;    ///< start of the member's key; of the value where there is no key
  std::uint32_t value = 0;  ///< start of the value
};

struct JsonReading {
  Json value;                     ///< meaningful only if `errors` is empty
  std::vector<JsonPlace> places;  ///< of every value, a container before its parts, in text order
  Diagnostics errors;
};

/// Parses `text`, the content of `file`. Refuses malformed JSON, NaN and Infinity, text that is not
/// UTF-8, numbers beyond f64, more than `deepest_json` levels and two equal keys in one object.
JsonReading parse_strictly(const std::string& text, const std::string& file);

/// Looks up lines and columns in `text`, which `json` is the reading of; sorts the diagnostics by
/// them and drops repeated ones. A pointer that is not there takes the place of the nearest part of
/// it that is. Diagnostics that have a place already, in another file, lose their pointer: it says
/// only where that file is named.
void locate(const JsonReading& json, const std::string& text, const std::string& file,
            Diagnostics& diagnostics);

}  // namespace grainsweep
