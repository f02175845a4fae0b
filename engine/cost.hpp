// What a packing will cost.
#pragma once

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Estimates: for sorting and planning, not promises. bench/README.md compares them with
/// measurements.
struct Cost {
  double cpu_seconds = 0.0;  ///< on one core of a present-day machine
  double bytes = 0.0;        ///< peak memory
};
Cost estimate_cost(const PackingSpec& spec);

}  // namespace grainsweep
