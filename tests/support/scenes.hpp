// Beds that tests start from.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep::testing {

inline constexpr Boundary periodic = Boundary::periodic, walls = Boundary::walls;

/// Range of radii and of heights of a random bed, d.
struct RandomScene {
  Box box;
  std::size_t grains = 100;
  double min_radius = 0.5, largest_radius = 0.5;
  double height = 5.0;  ///< centres lie in 0 .. height
  std::uint64_t seed = 1;
};

/// Spheres at random, overlapping as they come; their surfaces may cross walls.
SphereBed random_bed(const RandomScene& scene);

/// Spheres of diameter 1 at the points of a simple cubic lattice of spacing 1 on the floor, in a
/// bi-periodic box of nx by ny, nz layers.
SphereBed simple_cubic_bed(int nx, int ny, int nz);

/// The same for the face-centred cubic lattice (edge sqrt 2, four spheres a cell).
SphereBed fcc_bed(int nx, int ny, int nz);

/// Spheres of diameter 1 exactly above each other, `gap` between them and below the lowest.
SphereBed column_bed(int grains, double gap);

/// Box of a specification.
inline Box box_of(const Box& box) { return {box.length, box.width, box.x, box.y}; }

}  // namespace grainsweep::testing
