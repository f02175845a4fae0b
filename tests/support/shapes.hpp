// Shapes and poses that tests start from.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/shape/hull.hpp"
#include "engine/shape/pinacoid.hpp"
#include "engine/shape/pose.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep::testing {

/// Throws if the points span no volume.
ConvexShape hull_of(const std::vector<Vector>& points);

/// The same, as a packing asks for it.
HullVertices asked_for(const std::vector<Vector>& points);

ConvexShape box_shape(double length, double width, double height);
ConvexShape cube();
ConvexShape tetrahedron();
ConvexShape octahedron();
/// 20 corners.
ConvexShape dodecahedron();
/// 12 corners.
ConvexShape icosahedron();
/// An upright prism over a regular polygon whose corners lie on a circle of diameter 1.
ConvexShape prism(int sides, double height);

Vector random_direction(Draw& draw);

/// Points on an ellipsoid with half axes of 0.3 to 0.5 d: all of them are corners.
std::vector<Vector> random_corners(Draw& draw, int count);

/// Uniform over all rotations (Shoemake).
Quaternion random_rotation(Draw& draw);

/// Whether -x is a vertex for every vertex x, to rounding.
inline bool is_symmetric(const ConvexShape& shape) {
  const auto has = [&](const Vector& x) {
    return std::any_of(shape.vertices.begin(), shape.vertices.end(),
                       [&](const Vector& v) { return (v - x).norm() <= 1e-12; });
  };
  return std::all_of(shape.vertices.begin(), shape.vertices.end(),
                     [&](const Vector& v) { return has(-v); });
}

}  // namespace grainsweep::testing
