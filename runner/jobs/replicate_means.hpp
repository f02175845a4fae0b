// What the first packings of a group say about its means, which decides how groups and fits grow.
#pragma once

#include <vector>

#include "runner/store/outcome.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep {

/// Whether fewer than one in six packings settle. What settles so seldom grows no more: every value
/// of a mean would cost six beds that take all their steps.
constexpr bool settle_too_seldom(int settled, int packings) { return 6 * settled < packings; }

/// Half of the 95 % interval (Student) of the mean of n values with this standard deviation;
/// infinite for less than two values.
double half_interval(double sd, int n);

/// Solid fractions and coordination numbers, the height of the slab that they are means over, d,
/// and numbers of grains.
struct Means {
  Spread solid_fraction, coordination, slab_height, grains;

  bool are_of_one_state() const {
    return are_in_one_state(solid_fraction, coordination, grains.mean);
  }
};

/// Those of the settled packings among the first `count`, all of which are made.
Means means_of(const std::vector<const Outcome*>& made, int count);

}  // namespace grainsweep
