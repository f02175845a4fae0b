// The pinacoid: a double hip roof, the polyhedron of the reference study.
//
// With a = length / 2, b = width / 2, e = height / 2, s = e / tan(angle) and c = a - s its vertices
// are (+-a, +-b, 0) and (+-c, 0, +-e), x along the length, y along the width, z along the height.
// `angle` is that between the end triangles and the middle plane. With c = 0 the ridges are points.
#pragma once

#include <string>

#include "engine/shape/convex_shape.hpp"
#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

/// What forbids a pinacoid of this size, with what to change; "" if nothing does.
std::string problem_with(const PinacoidSize& size);

/// The shape in closed form. Requires problem_with(size).empty(). Its frame is the one above,
/// whatever the order of its principal moments.
ConvexShape pinacoid(const PinacoidSize& size);

}  // namespace grainsweep
