// Volume of a polyhedron between two parallel planes, exactly: what profiles and the solid fraction
// of a slab are made of.
#pragma once

#include "engine/measure/slab.hpp"
#include "engine/shape/pose.hpp"

namespace grainsweep {

/// Volume of the part of a grain where low <= coordinate <= high along `axis` of the box (0 x, 1 y,
/// 2 z), d^3. `low` and `high` may be infinite.
double slab_volume(const ConvexShape& shape, const Pose& pose, int axis, double low, double high);

/// Volume of the part of a grain where low.y <= y <= high.y and low.z <= z <= high.z, d^3: a bin of
/// a profile along y, within a slab. The x of `low` and `high` are bounds likewise; any of them may
/// be infinite.
double box_volume(const ConvexShape& shape, const Pose& pose, const Vector& low,
                  const Vector& high);

/// Lowest and highest coordinate of a grain along `axis` of the box, d.
Span span_along(const ConvexShape& shape, const Pose& pose, int axis);

}  // namespace grainsweep
