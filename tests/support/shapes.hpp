// Shapes and poses that tests start from.
#pragma once

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

Vector random_direction(Draw& draw);

/// Points on an ellipsoid with half axes of .3 to .5 d: all of them are corners.
std::vector<Vector> random_corners(Draw& draw, int count);

/// Uniform over all rotations (Shoemake).
Quaternion random_rotation(Draw& draw);

}  // namespace grainsweep::testing
