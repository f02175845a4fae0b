// The parameters about the sizes of grains.
#pragma once

#include <vector>

#include "runner/sweep/parameters.hpp"

namespace grainsweep {

/// Rows of the table of parameters: two classes, and the distributions in their place.
std::vector<Parameter> size_parameters();

/// The distribution that is being written; a new one if there is none yet.
SizeDistribution& distribution_of(ResolvedSpec& resolved);

/// Writes all diameters of a distribution in units of `size`, a length in theirs.
void to_units_of(double size, SizeDistribution& distribution);

}  // namespace grainsweep
