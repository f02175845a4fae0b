// What is measured of one packing beyond its solid fraction and coordination: curves, and numbers
// about order and forces. Plain results; engine/measure/profile.hpp and order.hpp say how they are
// made.
#pragma once

#include <cstdint>
#include <vector>

namespace grainsweep {

/// One bin of a profile: a slice of the measured part of the bed.
struct ProfileBin {
  double large = 0.0;             ///< solid volume of the large class over the bin's volume
  double small = 0.0;             ///< the same of the small class
  std::int64_t large_grains = 0;  ///< grains of the large class whose centre is in the bin
  std::int64_t small_grains = 0;
  std::int64_t neighbours = 0;  ///< touching grains of the grains in the bin, added up
  std::int64_t walls = 0;       ///< touching walls and floor of the grains in the bin, added up
};

/// Bins of equal width along one axis; bin k reaches from k to k + 1 bin widths.
struct Profile {
  double bin_width = 0.0;  ///< d
  std::vector<ProfileBin> bins;
};

}  // namespace grainsweep
