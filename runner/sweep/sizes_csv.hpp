// A table of grain sizes from a CSV file: a sieve curve.
//
// The first line names the columns: diameter, and passing (the share finer than it), retained (on a
// sieve of this opening: of grains from there to the next larger one; in grams, percent or shares
// of all) or share (of the grains of just this diameter); others are ignored. A row per line, in
// any order, with decimal points.
#pragma once

#include <string>

#include "engine/scene/size_distribution.hpp"
#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

struct SizesReading {
  SizeTable table;     ///< ascending, in the file's own unit of length
  Diagnostics errors;  ///< with places "sieves.csv:12"; at most 20 of a file
};

/// Reads a table from the file at `path`. Refuses missing columns, values that are no finite
/// numbers, and what is no table of sizes, each at its line.
SizesReading read_sizes(const std::string& path);

/// The same from `text`, the content of `file`.
SizesReading parse_sizes(const std::string& text, const std::string& file);

}  // namespace grainsweep
