// The closest points of two convex shapes: GJK with signed volumes.
//
// Gilbert, Johnson, Keerthi 1988; the sub-algorithm of Montanari, Petrinic, Barbieri 2017 (signed
// volumes). f64 throughout. Works for any convex shape but spheres (ConvexShape::is_ball), which it
// would take for their centres. Where rounding leaves a doubt whether the shapes overlap the
// separating axes decide.
#pragma once

#include "engine/narrow/shape_pair.hpp"

namespace grainsweep {

struct Closest {
  double distance = 0.0;         ///< d; 0 if the shapes overlap
  Vector on_a = Vector::Zero();  ///< closest points, frame of a; any common point if overlapping
  Vector on_b = Vector::Zero();
  bool overlap = false;    ///< the shapes share a point, or are closer than rounding can resolve
  bool converged = false;  ///< false never happened; then distance is an upper bound
};

/// Starts from the corners that lie towards each other's centre. `kernels` serve the axes.
Closest closest_points(const ShapePair& pair, const HullKernels& kernels);

}  // namespace grainsweep
