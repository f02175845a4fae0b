#include "engine/narrow/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/narrow/ball_pair.hpp"
#include "engine/narrow/clip.hpp"

namespace grainsweep {

namespace {

// Share of the pair's size below which an edge touches the plane of its axis.
constexpr double on_plane = 1e-9;

bool closer_than(const ShapePair& pair, double margin) {
  const double reach = pair.size() + margin;
  return pair.pose.centre.squaredNorm() <= reach * reach;
}

/// No contact: the shapes are that far apart or further.
PairContact apart_by(double separation) {
  PairContact none;
  none.separation = separation;
  return none;
}

/// By how much GJK parts a pair that is further apart than the margin; it then remembers the axis.
std::optional<double> parted_by_distance(const ShapePair& pair, double margin,
                                         const HullKernels& kernels, PairMemory& memory) {
  const Closest closest = closest_points(pair, kernels);
  if (closest.distance <= margin) return {};
  const Vector axis = (closest.on_b - closest.on_a).normalized();
  // The axis itself must part them: where rounding leaves a doubt they touch.
  const double separation = separation_along(pair, axis);
  if (!(separation > margin)) return {};
  memory.axis = axis;
  return separation;
}

/// Whether edges part the pair better than every face by more than this.
bool edges_part_better(const ContactAxes& axes, double preference) {
  return axes.edges.kind != AxisKind::none &&
         axes.edges.separation > axes.face.separation + preference;
}

/// Where nothing lies above the touching face, or no edges cross: a point between the closest
/// points.
void touch_between(const ShapePair& pair, const HullKernels& kernels, PairContact& contact,
                   std::vector<ContactPoint>& points) {
  const Closest closest = closest_points(pair, kernels);
  points.push_back({(closest.on_a + closest.on_b) / 2.0, contact.separation});
  contact.is_beside = true;
}

void touch_faces(const ShapePair& pair, const ContactAxis& axis, double margin,
                 ClipColumns& columns, std::vector<ContactPoint>& points) {
  if (axis.kind == AxisKind::face_of_a) {
    clip_on_face(pair, Of::a, axis.a, margin, columns, points);
  } else {
    clip_on_face(pair, Of::b, axis.b, margin, columns, points);
  }
}

void touch_edges(const ShapePair& pair, const ContactAxis& axis, double margin,
                 PairContact& contact, std::vector<ContactPoint>& points) {
  const Segment edge_a = farthest_edge(pair, Of::a, axis.a, axis.normal);
  const Segment edge_b = farthest_edge(pair, Of::b, axis.b, -axis.normal);
  const double between = axis.normal.dot(edge_b.from - edge_a.from);
  if (std::abs(between - axis.separation) > on_plane * pair.size()) return;
  const Closeness closest = closest_of(edge_a, edge_b);
  points.push_back({closest.midway, axis.separation});
  contact.is_beside = closest.distance > margin;
}

PairContact touch_along(const ShapePair& pair, const ContactAxis& axis, double margin,
                        ClipColumns& columns, std::vector<ContactPoint>& points) {
  PairContact contact{axis.normal, axis.separation, axis.kind, points.size(), 0};
  if (axis.kind == AxisKind::edges) {
    contact.edges = {axis.a, axis.b};
    touch_edges(pair, axis, margin, contact, points);
  } else {
    touch_faces(pair, axis, margin, columns, points);
  }
  if (points.size() == contact.first) touch_between(pair, *columns.kernels, contact, points);
  contact.count = points.size() - contact.first;
  return contact;
}

/// Whether what touches lies above the face: if edges part the pair better than any face, at least
/// one point must be no further from the face than the edges are from each other, plus `beyond`.
bool is_above_face(const ContactAxes& axes, const PairContact& contact,
                   const std::vector<ContactPoint>& points, double beyond) {
  if (!edges_part_better(axes, 0.0)) return true;
  const double nearest = min_gap(points.data() + contact.first, contact.count);
  return !contact.is_beside && nearest <= axes.edges.separation + beyond;
}

/// The contact along the preferred axis.
PairContact touch_preferred(const ShapePair& pair, const TouchSettings& settings,
                            const ContactAxes& axes, ClipColumns& columns,
                            std::vector<ContactPoint>& points) {
  const bool edges = edges_part_better(axes, settings.preference);
  const double overlap = edges ? std::max(0.0, -axes.edges.separation) : 0.0;
  if (!edges_part_better(axes, settings.preference + settings.of_depth * overlap)) {
    PairContact contact = touch_along(pair, axes.face, settings.margin, columns, points);
    const double beyond = edges ? 0.0 : settings.preference;
    if (is_above_face(axes, contact, points, beyond)) return contact;
    points.resize(contact.first);
  }
  return touch_along(pair, axes.edges, settings.margin, columns, points);
}

/// The contact of a pair with a sphere.
PairContact touch_ball(const ShapePair& pair, double margin, PairMemory& memory,
                       std::vector<ContactPoint>& points) {
  const BallContact contact = ball_contact(pair);
  memory.axis = contact.normal;
  if (contact.gap > margin) return apart_by(contact.gap);
  points.push_back({contact.position, contact.gap});
  return {contact.normal, contact.gap, contact.kind, points.size() - 1, 1};
}

}  // namespace

double min_gap(const ContactPoint* points, std::size_t count) {
  double least = points->gap;
  for (std::size_t k = 1; k < count; ++k) least = std::min(least, points[k].gap);
  return least;
}

PairContact touch(const ShapePair& pair, const TouchSettings& settings, const ContactAxes& axes,
                  ClipColumns& columns, std::vector<ContactPoint>& points) {
  if (!(axes.separation() <= settings.margin)) return apart_by(axes.separation());
  PairContact contact = touch_preferred(pair, settings, axes, columns, points);
  contact.parted = axes.separation();
  return contact;
}

PairContact touch(const ShapePair& pair, const TouchSettings& settings, PairMemory& memory,
                  TouchColumns& columns, std::vector<ContactPoint>& points) {
  const double margin = settings.margin;
  if (!closer_than(pair, margin)) return apart_by(pair.pose.centre.norm() - pair.size());
  if (!memory.touched && !memory.axis.isZero(0.0)) {
    const double separation = separation_along(pair, memory.axis);
    if (separation > margin) return apart_by(separation);
  }
  memory.touched = false;
  if (has_ball(pair)) return touch_ball(pair, margin, memory, points);
  const ContactAxes axes = separating_axes(pair, memory.axis, memory.candidates, columns.axes);
  memory.axis = axes.best().normal;
  PairContact contact = touch(pair, settings, axes, columns.clip, points);
  if (contact.count == 0) return contact;
  if (contact.is_beside) {
    if (const std::optional<double> separation =
            parted_by_distance(pair, margin, *columns.axes.kernels, memory)) {
      points.resize(contact.first);
      return apart_by(*separation);
    }
  }
  memory.touched = true;
  return contact;
}

std::size_t touch_wall(const ConvexShape& shape, const Pose& pose, const Wall& wall, double margin,
                       std::vector<ContactPoint>& points) {
  const Vector& c = pose.centre;
  const UnitVector inward = wall.normal(c.x(), c.y(), c.z());
  const Vector normal = pose.orientation.conjugate() * Vector(inward.x, inward.y, inward.z);
  const double centre = wall.distance(c.x(), c.y(), c.z());
  if (shape.is_ball) {
    const double radius = pose.scale * shape.inradius;
    if (centre - radius > margin) return 0;
    points.push_back({-radius * normal, centre - radius});
    return 1;
  }
  const std::size_t before = points.size();
  for (const Vector& vertex : shape.vertices) {
    const double gap = centre + pose.scale * normal.dot(vertex);
    if (gap <= margin) points.push_back({pose.scale * vertex, gap});
  }
  return points.size() - before;
}

}  // namespace grainsweep
