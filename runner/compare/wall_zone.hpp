// The zone beside the walls in which grains touch fewer others.
//
// From the coordination profile of each packing: the wall value is the mean over grains whose
// centre lies in the bins nearer to a wall than first_layer, the core value that over grains
// farther from both walls than core_distance. Walls do not count as neighbours.
#pragma once

#include <string>

#include "runner/tables/groups.hpp"

namespace grainsweep {

inline constexpr double first_layer = 0.6;    ///< d: centres of large grains that touch the wall
inline constexpr double core_distance = 4.0;  ///< d: as far as walls are said to reach

struct WallZone {
  std::string not_determined;  ///< why there are no numbers; empty if there are
  Spread drop;                 ///< core less wall coordination, over the settled replicates
  /// Width of a layer of wall coordination beside each wall that, with core coordination elsewhere,
  /// gives the packing's mean: (W / 2) (core - mean) / (core - wall), d.
  Spread width;
};

/// Not determined without walls along y, with a core thinner than 1 d, with fewer than two settled
/// replicates, or where a zone holds no grain.
WallZone wall_zone(const Group& group);

}  // namespace grainsweep
