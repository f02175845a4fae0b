// The sizes of a bed's grains beside the distribution that was asked for.
#pragma once

#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/size_distribution.hpp"

namespace grainsweep {

/// A row for each diameter of a table, or for 25 diameters of another curve, evenly spaced in their
/// logarithm. A diameter counts the grains that are as large, too. Shares of a slab without grains
/// are NaN.
std::vector<SizeRow> size_rows(const Grains& bed, const SizeCurve& curve, const Slab& slab);

}  // namespace grainsweep
