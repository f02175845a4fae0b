// sizes.csv: distributions of grain sizes, asked and packed, a row per diameter.
#pragma once

#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// The share of the grains up to a diameter.
struct SizeLine {
  double diameter = 0.0;  ///< d
  double asked = 0.0;     ///< of the distribution
  Spread packed, slab;    ///< of all grains, and of those in the measured slab
};

/// Over the settled packings of a group, from fine to coarse; empty for grains without a
/// distribution.
std::vector<SizeLine> mean_sizes(const Group& group);

CurveTable sizes_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
