// Balls around grains: all that the broad phase sees of them. Spheres are their own.
#pragma once

#include <vector>

#include "engine/scene/bed.hpp"

namespace grainsweep {

struct Balls {
  const Grains& bed;
  const std::vector<Record<double>>& ball;  ///< centre and radius of each grain's, d
};

/// The balls of a bed; `column` may be used as their memory and must outlive them.
inline Balls balls_of(const SphereBed& bed, std::vector<Record<double>>& /*column*/) {
  return {bed, bed.position};
}
/// For polyhedra, the smallest balls about the centroids.
inline Balls balls_of(const PolyhedronBed& bed, std::vector<Record<double>>& column) {
  column.resize(bed.grains());
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    column[i] = {p.x, p.y, p.z, bed.circumradius(i)};
  }
  return {bed, column};
}

}  // namespace grainsweep
