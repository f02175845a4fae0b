// How the contact forces of a bed at rest are distributed.
#pragma once

#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/results.hpp"

namespace grainsweep {

struct ForceStatistics {
  double mean = 0.0;    ///< of the forces in the slab, m g; NaN if there are none
  double square = 0.0;  ///< mean square of the relative forces; 2 if they were exponential
  Curve density;        ///< probability density of the relative forces
};

/// Forces whose height lies in the slab. Each is taken relative to the mean of its layer, 1 d thick
/// from the slab's bottom up, because the weight to be carried grows with depth. `bin_width` and
/// `largest` are relative forces; forces beyond `largest` have their share of the probability.
ForceStatistics force_statistics(const std::vector<PairForce>& forces, const Slab& slab,
                                 double bin_width, double largest);

}  // namespace grainsweep
