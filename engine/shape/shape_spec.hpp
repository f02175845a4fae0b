// What the grains of a packing are, as it is asked for: plain data, worked out into a ConvexShape
// by engine/shape/pinacoid.hpp and engine/shape/hull.hpp. Spheres need no more than their name.
#pragma once

#include <array>
#include <variant>
#include <vector>

namespace grainsweep {

struct SphereShape {};

/// A pinacoid of size 1; see engine/shape/pinacoid.hpp.
struct PinacoidSize {
  double length = 1.0;                ///< d
  double width = 1.0;                 ///< d
  double height = 1.0;                ///< d
  double angle = 1.0471975511965976;  ///< radians, in (0, pi / 2]
};

/// The convex hull of points, which are its vertices; see engine/shape/hull.hpp.
struct HullVertices {
  std::vector<std::array<double, 3>> points;  ///< of a grain of size 1, d
};

using ShapeSpec = std::variant<SphereShape, PinacoidSize, HullVertices>;

}  // namespace grainsweep
