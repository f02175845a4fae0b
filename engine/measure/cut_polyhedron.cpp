#include "engine/measure/cut_polyhedron.hpp"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "engine/measure/cut_sphere.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

using Tetrahedron = std::array<Vector, 4>;

/// Keeps what lies where sign * x[axis] <= bound.
struct Plane {
  int axis;
  double sign, bound;

  double beyond(const Vector& x) const { return sign * x[axis] - bound; }
};

/// Planes that cut a grain, at most two per axis.
struct Planes {
  std::array<Plane, 6> plane = {};
  std::size_t count = 0;
};

double volume_of(const Tetrahedron& t) {
  return std::abs((t[1] - t[0]).dot((t[2] - t[0]).cross(t[3] - t[0]))) / 6.0;
}

double cut_volume(const Tetrahedron& t, const Planes& planes, std::size_t next);

/// Volume of the prism between triangles p0 p1 p2 and q0 q1 q2, cut by the planes from `next` on.
double cut_prism(const Vector& p0, const Vector& p1, const Vector& p2, const Vector& q0,
                 const Vector& q1, const Vector& q2, const Planes& planes, std::size_t next) {
  return cut_volume({p0, p1, p2, q0}, planes, next) + cut_volume({p1, p2, q0, q1}, planes, next) +
         cut_volume({p2, q0, q1, q2}, planes, next);
}

/// Volume of a tetrahedron cut by the planes from `next` on. The corners that one plane keeps come
/// first; what it leaves is a tetrahedron or a prism.
double cut_volume(const Tetrahedron& t, const Planes& planes, std::size_t next) {
  if (next == planes.count) return volume_of(t);
  const Plane& plane = planes.plane[next];
  std::array<std::pair<double, Vector>, 4> corner;
  for (std::size_t k = 0; k < 4; ++k) corner[k] = {plane.beyond(t[k]), t[k]};
  const auto outside = std::stable_partition(corner.begin(), corner.end(),
                                             [](const auto& c) { return c.first <= 0.0; });
  const auto at = [&](std::size_t k) -> const Vector& { return corner[k].second; };
  const auto cut = [&](std::size_t in, std::size_t out) -> Vector {
    const double share = corner[in].first / (corner[in].first - corner[out].first);
    return at(in) + share * (at(out) - at(in));
  };
  switch (outside - corner.begin()) {
    case 0:
      return 0.0;
    case 1:
      return cut_volume({at(0), cut(0, 1), cut(0, 2), cut(0, 3)}, planes, next + 1);
    case 2:
      return cut_prism(at(0), cut(0, 2), cut(0, 3), at(1), cut(1, 2), cut(1, 3), planes, next + 1);
    case 3:
      return cut_prism(at(0), at(1), at(2), cut(0, 3), cut(1, 3), cut(2, 3), planes, next + 1);
    default:
      return cut_volume(t, planes, next + 1);
  }
}

/// The planes that cut through the grain; no value if all of it lies outside one of them.
bool planes_through(const ConvexShape& shape, const Pose& pose, const Vector& low,
                    const Vector& high, Planes& planes) {
  for (int axis = 0; axis < 3; ++axis) {
    const Span span = span_along(shape, pose, axis);
    if (span.high <= low[axis] || span.low >= high[axis]) return false;
    if (span.low < low[axis]) planes.plane[planes.count++] = {axis, -1.0, -low[axis]};
    if (span.high > high[axis]) planes.plane[planes.count++] = {axis, 1.0, high[axis]};
  }
  return true;
}

/// The same volume for a sphere among polyhedra.
double ball_volume(double radius, const Vector& centre, const Vector& low, const Vector& high) {
  const auto from_centre = [&](int axis) {
    return Span{low[axis] - centre[axis], high[axis] - centre[axis]};
  };
  return sphere_box_volume(radius, from_centre(0), from_centre(1), from_centre(2));
}

}  // namespace

Span span_along(const ConvexShape& shape, const Pose& pose, int axis) {
  const Vector along = pose.orientation.conjugate() * Vector::Unit(axis);
  return {pose.centre[axis] - pose.scale * reach_along(shape, -along),
          pose.centre[axis] + pose.scale * reach_along(shape, along)};
}

double box_volume(const ConvexShape& shape, const Pose& pose, const Vector& low,
                  const Vector& high) {
  if (shape.is_ball) return ball_volume(pose.scale * shape.inradius, pose.centre, low, high);
  Planes planes{};
  if (!planes_through(shape, pose, low, high, planes)) return 0.0;
  if (planes.count == 0) return shape.volume_at(pose.scale);
  const Matrix turn = pose.scale * pose.orientation.toRotationMatrix();
  double volume = 0.0;
  for (const Face& face : shape.faces) {
    const std::span<const std::int32_t> corners = corners_of(shape, face);
    const auto corner = [&](std::size_t k) -> Vector {
      return pose.centre + turn * shape.vertices[static_cast<std::size_t>(corners[k])];
    };
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      volume += cut_volume({pose.centre, corner(0), corner(k), corner(k + 1)}, planes, 0);
    }
  }
  return volume;
}

double slab_volume(const ConvexShape& shape, const Pose& pose, int axis, double low, double high) {
  if (shape.is_ball) {
    const double at = pose.centre[axis];
    return sphere_slab_volume(pose.scale * shape.inradius, low - at, high - at);
  }
  Vector lows = Vector::Constant(-infinity), highs = Vector::Constant(infinity);
  lows[axis] = low;
  highs[axis] = high;
  return box_volume(shape, pose, lows, highs);
}

}  // namespace grainsweep
