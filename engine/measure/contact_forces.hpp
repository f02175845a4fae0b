// Contact forces of a bed at rest, and how they are distributed.
//
// The forces are those of one more step from the final positions, in which the contacts keep the
// weight from falling: a solve of force balance that starts from nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/measure/curves.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// A force that two grains exert on each other.
struct PairForce {
  std::int32_t a = 0, b = 0;
  double height = 0.0;     ///< mean z of the two centres, d
  double magnitude = 0.0;  ///< m g
};

/// All pairs that press on each other by more than 1e-6 m g. `dt`: the step, sqrt(d/g).
std::vector<PairForce> pair_forces(const SphereBed& bed, const Kernels& kernels, double dt);

struct ForceStatistics {
  double mean = 0.0;    ///< of the forces in the slab, m g; NaN if there are none
  double square = 0.0;  ///< mean square of the relative forces; 2 if they were exponential
  Curve density;        ///< probability density of the relative forces
};

/// Forces whose height lies in the slab. Each is taken relative to the mean of its layer, 1 d thick
/// from the slab's bottom up, because the weight to be carried grows with depth. `bin_width` and
/// `largest` are relative forces; what lies beyond has its share of the probability.
ForceStatistics force_statistics(const std::vector<PairForce>& forces, const Slab& slab,
                                 double bin_width, double largest);

}  // namespace grainsweep
