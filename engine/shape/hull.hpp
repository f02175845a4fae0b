// The convex hull of points as a shape, by Qhull; coplanar triangles are merged into polygons.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/shape/build.hpp"
#include "engine/shape/convex_shape.hpp"

namespace grainsweep {

struct Hull {
  /// In its own frame: that of the points, moved, where it is principal already; otherwise turned
  /// to ascending moments.
  std::optional<ConvexShape> shape;
  std::string error;  ///< what forbids a hull, with what to change; "" with a shape
};

/// The hull of `points` (d). Refuses fewer than 4 points, NaN and infinite coordinates, points
/// given twice, and points that lie on a plane or a line. Points inside the hull are refused too: a
/// shape that is not convex would silently become another.
Hull convex_hull(const std::vector<Vector>& points);

/// The faces of the hull of `points`, which keep their numbers; those within it are on no face.
/// Throws std::invalid_argument where there is no hull.
Loops hull_faces(const std::vector<Vector>& points);

}  // namespace grainsweep
