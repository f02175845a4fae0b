// The sizes of a bed's grains beside the distribution that was asked for.
#pragma once

#include <span>
#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/size_distribution.hpp"

namespace grainsweep {

/// A row for each diameter of a table, or for 25 diameters of another curve, evenly spaced in their
/// logarithm. Grains of exactly a row's diameter are counted in it, too. Shares of a slab without
/// grains are NaN. `unit_weights`: what each grain would weigh in these shares if its size were 1,
/// in any unit.
std::vector<SizeRow> size_rows(const Grains& bed, const SizeCurve& curve, const Slab& slab,
                               std::span<const double> unit_weights);

}  // namespace grainsweep
