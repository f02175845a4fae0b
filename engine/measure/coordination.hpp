// Coordination number: how many neighbours a grain touches.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/measure/touching.hpp"
#include "engine/results.hpp"

namespace grainsweep {

/// Mean over the grains whose centre lies in the slab (bottom <= z < top), both conventions; pairs
/// and walls count if their gap is below `gap_tolerance`. NaN if no grain is in the slab.
Coordination coordination(const Grains& bed, const Touching& touching, const Slab& slab,
                          double gap_tolerance);

/// Touching grains of each grain, walls not counted.
std::vector<std::int32_t> neighbour_counts(std::size_t grains, const Touching& touching,
                                           double gap_tolerance);

}  // namespace grainsweep
