// From the shape that a packing asks for to the one it is made with.
#pragma once

#include <cstddef>

#include "engine/shape/hull.hpp"
#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

inline bool is_sphere(const ShapeSpec& spec) { return std::holds_alternative<SphereShape>(spec); }

/// The convex shape of a spec that is not a mixture, or what forbids it; a sphere gets the shape of
/// a sphere among polyhedra.
Hull shape_of(const ShapeSpec& spec);

/// Number of corners of a shape that nothing forbids; 0 for a sphere, for a mixture the mean over
/// the grains.
std::size_t corner_count(const ShapeSpec& spec);

/// What a check of sizes has to know of a shape, at size 1.
struct ShapeExtent {
  double volume = 0.0;        ///< of a mixture the mean over the grains, d^3
  double circumradius = 0.0;  ///< of a mixture the largest, d
  double inradius = 0.0;      ///< of a mixture the least, d
};
ShapeExtent extent_of(const ConvexShape& shape);

/// The same for any shape, spheres too. Requires a shape that nothing forbids.
ShapeExtent extent_of(const ShapeSpec& spec);

}  // namespace grainsweep
