// How far the grains of a bed have come.
//
// Two grains that are apart stay so until their surfaces have come, together, as far as they were
// apart: until then there is no need to look at them. Most pairs that are near enough to be listed
// are not looked at in most steps of a bed that comes to rest.
#pragma once

#include <vector>

#include "engine/context.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Kept from step to step. A default one is of grains that have not been seen.
struct Travel {
  /// Where each grain was seen last, and how it lay: see Bed<Polyhedron>.
  std::vector<Record<double>> position, orientation;
  /// Of each grain, no less than the way that any point of it has come since it was first seen, d:
  /// from call to call in a straight line.
  std::vector<double> way;
};

/// Adds how far grains have come since the last call, wherever they have been wrapped.
void add_travel(const PolyhedronBed& bed, const ParallelFor& loop, Travel& travel);

}  // namespace grainsweep
