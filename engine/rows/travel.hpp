// How far the grains of a bed have moved.
//
// Two grains that are apart stay so until their surfaces have together moved as far as they were
// apart: until then there is no need to look at them. Most pairs that are near enough to be listed
// are not looked at in most steps of a bed that comes to rest.
#pragma once

#include <vector>

#include "engine/context.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Kept from step to step. A default one is for grains that have not been seen yet.
struct Travel {
  /// Position and orientation of each grain when it was seen last: see Bed<Polyhedron>.
  std::vector<Record<double>> position, orientation;
  /// For each grain, an upper bound of the distance that any of its points has moved since it was
  /// first seen, d, in straight lines from call to call.
  std::vector<double> way;
};

/// Adds how far grains have moved since the last call, however they have been wrapped.
void add_travel(const PolyhedronBed& bed, const ParallelFor& loop, Travel& travel);

}  // namespace grainsweep
