// The convex hull of points as a shape, by Qhull; triangles that lie nearly on one plane are merged
// into polygons, and these made flat: mesh files round their numbers, and faces bent only by that
// rounding would touch each other triangle by triangle.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/shape/build.hpp"
#include "engine/shape/convex_shape.hpp"

namespace grainsweep {

/// Unevenness up to which a face is taken to be flat, as a share of the hull's least extent: for
/// points that people or programs wrote down, and for those of a hull that was already flattened.
inline constexpr double flat_as_written = 1e-4, flat_as_stored = 1e-11;

struct Hull {
  /// In its own frame: that of the points, moved, where it is principal already; otherwise turned
  /// to ascending moments.
  std::optional<ConvexShape> shape;
  std::string error;  ///< what forbids a hull, with what to change; "" with a shape
};

/// The hull of `points` (d). Faces that lie within the share `flat` of one plane are made one flat
/// face, their corners moved by about as much; with 0, only faces that rounding alone has bent are
/// joined. Refuses fewer than 4 points, NaN and infinite coordinates, points given twice, and
/// points that lie on a plane or a line. Points inside the hull are refused too: a shape that is
/// not convex would silently become another.
Hull convex_hull(const std::vector<Vector>& points, double flat = 0.0);

/// Where a body is not convex.
struct Dent {
  std::size_t face;  ///< the face of the body that lies deepest inside the hull
  double depth;      ///< of the middle of the edge or face that is deepest, d
  double extent;     ///< of the points, d
};

/// The deepest dent of the body that `faces` of `points` enclose, as of a notch, of a hole or
/// between lobes, whose corners may all lie on the hull; none if all faces lie on the hull to
/// within what convex_hull allows for points as written, or if there is no hull. Faces may have
/// corners in either order.
std::optional<Dent> deepest_dent(const std::vector<Vector>& points, const Loops& faces);

/// The faces of the hull of `points`, which keep their numbers; those within it are on no face.
/// Throws std::invalid_argument where there is no hull.
Loops hull_faces(const std::vector<Vector>& points);

}  // namespace grainsweep
