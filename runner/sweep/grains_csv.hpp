// Grains from a CSV file, from which a bed can start.
//
// The first line names the columns; x, y, z and r (or radius) must be among them, for non-spherical
// grains also qx, qy, qz and qw, and for those of a mixture the column component. What size_class
// says is noted, but what is small follows from the sweep. Other columns are ignored: a bed written
// by `export` can be packed again. One grain per line, decimal points.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/spec.hpp"
#include "runner/sweep/diagnostic.hpp"

namespace grainsweep {

/// Stands for a component that no mixture has.
inline constexpr std::uint8_t no_component = 255;

struct GrainsReading {
  std::vector<PlacedSphere> grains;  ///< in the file's own unit of length
  /// Quaternions as in PlacedGrains; empty if the file has no columns for them.
  std::vector<std::array<double, 4>> orientations;
  /// Components as in PlacedGrains, no_component where a cell holds no component's number; empty if
  /// the file has no column for them.
  std::vector<std::uint8_t> components;
  /// Which grains the column size_class calls small; empty if the file has none.
  std::vector<bool> are_small;
  std::string content;             ///< hash of the file's bytes, 16 hex digits
  std::vector<Diagnostic> errors;  ///< with places "bed.csv:12"; at most 20 of a file
};

/// Reads grains from the file at `path`. Refuses missing columns and values, some of the columns of
/// an orientation without the others, and radii that are not positive finite numbers.
GrainsReading read_grains(const std::string& path);

/// The same from `text`, the content of `file`.
GrainsReading parse_grains(const std::string& text, const std::string& file);

/// The grains in units of `diameter`, a length in the file's unit.
std::vector<PlacedSphere> scaled_grains(std::vector<PlacedSphere> grains, double diameter);

}  // namespace grainsweep
