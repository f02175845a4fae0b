#include "engine/narrow/ball_pair.hpp"

#include <algorithm>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Share of the size below which a distance gives no direction.
constexpr double no_direction = 1e-12;

struct Highest {
  const Face* face = nullptr;
  double height = -infinity;
};

/// The face that a point lies highest above.
Highest highest_face(const ConvexShape& shape, double scale, const Vector& x) {
  Highest best;
  for (const Face& face : shape.faces) {
    const double height = face.normal.dot(x) - scale * face.offset;
    if (height > best.height) best = {&face, height};
  }
  return best;
}

/// Whether a point lies between the sides of a face.
bool is_above(const ConvexShape& shape, double scale, const Face& face, const Vector& x) {
  const Side* const first = shape.sides.data() + face.first;
  return std::all_of(first, first + face.corners,
                     [&](const Side& side) { return side.outward.dot(x) <= scale * side.offset; });
}

/// The nearest point on the edges, and whether it is an end of one.
struct OnEdge {
  Vector point = Vector::Zero();
  bool is_corner = false;
};

OnEdge nearest_on_edges(const ConvexShape& shape, double scale, const Vector& x) {
  double least = infinity;
  OnEdge best;
  for (const Edge& edge : shape.edges) {
    const Vector from = scale * shape.vertices[static_cast<std::size_t>(edge.from)];
    const Vector along = scale * shape.vertices[static_cast<std::size_t>(edge.to)] - from;
    const double share = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vector point = from + share * along;
    const double squared = (x - point).squaredNorm();
    if (squared < least) {
      least = squared;
      best = {point, share == 0.0 || share == 1.0};
    }
  }
  return best;
}

/// The contact of a polyhedron with a sphere, both in the polyhedron's frame.
BallContact contact_with_ball(const ConvexShape& shape, double scale, const Vector& centre,
                              double radius) {
  const NearestPoint nearest = nearest_point(shape, scale, centre);
  const double gap = nearest.distance - radius;
  return {nearest.outward, nearest.point + gap / 2.0 * nearest.outward, gap, nearest.kind};
}

BallContact contact_of_balls(const Vector& centre, double radius_a, double radius_b) {
  const double distance = centre.norm();
  const Vector normal = distance > 0.0 ? Vector(centre / distance) : Vector(Vector::UnitZ());
  const double gap = distance - (radius_a + radius_b);
  return {normal, (radius_a + gap / 2.0) * normal, gap, AxisKind::round};
}

}  // namespace

NearestPoint nearest_point(const ConvexShape& shape, double scale, const Vector& of) {
  const Highest highest = highest_face(shape, scale, of);
  NearestPoint on_plane = {of - highest.height * highest.face->normal, highest.face->normal,
                           highest.height, AxisKind::ball_on_face};
  if (highest.height <= no_direction * scale || is_above(shape, scale, *highest.face, of)) {
    return on_plane;
  }
  for (const Face& face : shape.faces) {
    const double height = face.normal.dot(of) - scale * face.offset;
    if (height > 0.0 && is_above(shape, scale, face, of)) {
      return {of - height * face.normal, face.normal, height, AxisKind::ball_on_face};
    }
  }
  const OnEdge nearest = nearest_on_edges(shape, scale, of);
  const double distance = (of - nearest.point).norm();
  return {nearest.point, (of - nearest.point) / distance, distance,
          nearest.is_corner ? AxisKind::round : AxisKind::ball_on_edge};
}

BallContact ball_contact(const ShapePair& pair) {
  const PairPose& pose = pair.pose;
  const double radius_a = pose.scale_a * pair.a.inradius;
  const double radius_b = pose.scale_b * pair.b.inradius;
  if (pair.a.is_ball && pair.b.is_ball) return contact_of_balls(pose.centre, radius_a, radius_b);
  if (pair.b.is_ball) return contact_with_ball(pair.a, pose.scale_a, pose.centre, radius_b);
  const BallContact of_b =
      contact_with_ball(pair.b, pose.scale_b, -(pose.turn.transpose() * pose.centre), radius_a);
  return {-(pose.turn * of_b.normal), pose.centre + pose.turn * of_b.position, of_b.gap, of_b.kind};
}

}  // namespace grainsweep
