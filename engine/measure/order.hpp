// Order, forces and segregation of one packing, put together from their measurements.
#pragma once

#include <vector>

#include "engine/measure/profile.hpp"
#include "engine/measure/slab.hpp"
#include "engine/measure/touching.hpp"
#include "engine/results.hpp"

namespace grainsweep {

/// Share of the slab's grains that touch exactly `contacts` grains and walls. NaN without
/// grains.
double share_with_contacts(const Grains& bed, const Touching& touching, const Slab& slab,
                           double gap_tolerance, int contacts);

/// Mean height of the slab's small grains less that of its large ones, over the slab's height: 0 if
/// they are mixed evenly, positive if small grains float. NaN unless there are both.
double segregation(const Grains& bed, const Slab& slab, double small_below);

/// Everything in Order, and the curves of distances and forces. `near` must hold all pairs and
/// walls with a gap below the settings' tolerance, and all pairs with one below their bond_gap.
Order measure_order(const Grains& bed, const Touching& near,
                    const std::vector<PairForce>& pair_forces, const Slab& slab,
                    const ProfileSettings& settings, Curves& curves);

}  // namespace grainsweep
