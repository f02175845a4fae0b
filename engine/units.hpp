// Units inside the engine, once and for all.
//
// clang-format off
//   length  d              mean diameter of the large grains, or one of those of a distribution
//   mass    rho pi/6 d^3   a sphere of diameter d; a sphere of radius r has mass (2 r)^3.
//                          Of polyhedra: a grain of scale 1, of a mixture's first component
//   time    sqrt(d / g)
//   force   m g            weight of a grain of mass 1
// clang-format on
//
// So g = 1, and no result depends on density or gravity: a frictionless packing of rigid grains has
// no other scale. Lengths of a bed that comes from elsewhere are divided by its d on reading.
#pragma once

#include <limits>

namespace grainsweep {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Volume of a sphere of radius r, d^3.
inline double sphere_volume(double radius) { return 4.0 / 3.0 * pi * radius * radius * radius; }

/// Mass of a sphere of radius r, in masses of a sphere of diameter d.
inline double sphere_mass(double radius) { return 8.0 * radius * radius * radius; }

}  // namespace grainsweep
