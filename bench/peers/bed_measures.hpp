// What a settled bed is worth, whoever settled it: overlaps, contacts and the packing's own numbers
// from the final positions and radii alone, by the functions of engine/measure.
#pragma once

#include <cstdint>
#include <string>

#include "engine/packing.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep::bench {

/// Pairs and walls with a gap below this are near, d: the default tolerance of the coordination.
inline constexpr double near_gap = 1e-4;

struct BedMeasures {
  std::int64_t grains = 0;
  double overlap_mean = 0.0;     ///< over the overlapping contacts, d; 0 without any
  double overlap_max = 0.0;      ///< d
  std::int64_t overlapping = 0;  ///< pairs and walls with gap <= 0: what pushes in a soft code
  std::int64_t near = 0;         ///< pairs and walls with gap < near_gap
  std::int64_t isostatic = 0;    ///< 3 N - zero modes, clusters joined by the near contacts
  double solid_fraction = 0.0;   ///< of the slab from 3 d above the floor to 3 d below the top
  Coordination coordination;     ///< in that slab, at near_gap
};

/// Measures `bed` in the slab of `measure`. Wraps the bed. NaN where the slab holds no grain.
BedMeasures measures_of(SphereBed& bed, const MeasureSpec& measure, const Kernels& kernels);

/// Names of the columns of `csv_row`, with a line feed.
std::string csv_header();

/// One line of a CSV table; lengths in d.
std::string csv_row(const BedMeasures& measures);

}  // namespace grainsweep::bench
