#include "engine/narrow/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/narrow/clip.hpp"

namespace grainsweep {

namespace {

// Share of the pair's size below which an edge touches the plane of its axis.
constexpr double on_plane = 1e-9;

bool closer_than(const ShapePair& pair, double margin) {
  const double reach =
      pair.pose.scale_a * pair.a.circumradius + pair.pose.scale_b * pair.b.circumradius + margin;
  return pair.pose.centre.squaredNorm() <= reach * reach;
}

bool parted(const ShapePair& pair, const Vector& axis, double margin) {
  return !axis.isZero(0.0) && separation_along(pair, axis) > margin;
}

/// What GJK says of a pair that the axes are to look at: a face that parts the shapes by so much
/// needs no comparison with edges. Nothing if it finds them further apart than the margin; it then
/// remembers the axis. Pinacoids need no such test: their axes cost no more.
std::optional<double> enough_of_a_face(const ShapePair& pair, const TouchSettings& settings,
                                       PairMemory& memory) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (pair.a.pinacoid && pair.b.pinacoid) return infinity;
  const Closest closest = closest_points(pair, memory.simplex);
  if (closest.overlap) return infinity;
  if (closest.distance > settings.margin) {
    const Vector axis = (closest.on_b - closest.on_a).normalized();
    // What parts them must do so by itself: where rounding leaves a doubt the axes decide.
    if (parted(pair, axis, settings.margin)) {
      memory.axis = axis;
      return std::nullopt;
    }
  }
  // No edges part them by more than their distance.
  return closest.distance - settings.preference;
}

/// Whether edges part the pair better than every face by more than this.
bool edges_part_better(const ContactAxes& axes, double preference) {
  return axes.edges.kind != AxisKind::none &&
         axes.edges.separation > axes.face.separation + preference;
}

/// Where nothing lies above the touching face, or no edges cross: a point between the closest
/// points.
ContactPoint lone_point(const ShapePair& pair, double separation) {
  Simplex simplex;
  const Closest closest = closest_points(pair, simplex);
  return {(closest.on_a + closest.on_b) / 2.0, separation};
}

void touch_faces(const ShapePair& pair, const ContactAxis& axis, double margin,
                 ClipColumns& columns, std::vector<ContactPoint>& points) {
  if (axis.kind == AxisKind::face_of_a) {
    clip_on_face(pair, Of::a, axis.a, margin, columns, points);
  } else {
    clip_on_face(pair, Of::b, axis.b, margin, columns, points);
  }
}

void touch_edges(const ShapePair& pair, const ContactAxis& axis,
                 std::vector<ContactPoint>& points) {
  const PlacedShape a = placed_a(pair), b = placed_b(pair);
  const Segment edge_a = farthest_edge(a, axis.a, axis.normal);
  const Segment edge_b = farthest_edge(b, axis.b, -axis.normal);
  const double between = axis.normal.dot(edge_b.from - edge_a.from);
  const double size = a.scale * a.shape.circumradius + b.scale * b.shape.circumradius;
  const bool crossing = std::abs(between - axis.separation) <= on_plane * size;
  points.push_back(crossing ? ContactPoint{midway(edge_a, edge_b), axis.separation}
                            : lone_point(pair, axis.separation));
}

PairContact touch_along(const ShapePair& pair, const ContactAxis& axis, double margin,
                        ClipColumns& columns, std::vector<ContactPoint>& points) {
  PairContact contact{axis.normal, axis.separation, axis.kind, points.size(), 0};
  if (axis.kind == AxisKind::edges) {
    touch_edges(pair, axis, points);
  } else {
    touch_faces(pair, axis, margin, columns, points);
  }
  if (points.size() == contact.first) {
    points.push_back(lone_point(pair, axis.separation));
  }
  contact.count = points.size() - contact.first;
  return contact;
}

}  // namespace

double min_gap(const ContactPoint* points, std::size_t count) {
  double least = points->gap;
  for (std::size_t k = 1; k < count; ++k) least = std::min(least, points[k].gap);
  return least;
}

PairContact touch(const ShapePair& pair, const TouchSettings& settings, const ContactAxes& axes,
                  ClipColumns& columns, std::vector<ContactPoint>& points) {
  if (!(axes.separation() <= settings.margin)) return {};
  const bool edges = edges_part_better(axes, settings.preference);
  const double overlap = edges ? std::max(0.0, -axes.edges.separation) : 0.0;
  if (edges && !edges_part_better(axes, settings.preference + settings.of_depth * overlap)) {
    PairContact contact = touch_along(pair, axes.face, settings.margin, columns, points);
    const double deepest = min_gap(points.data() + contact.first, contact.count);
    if (deepest <= axes.edges.separation) return contact;
    points.resize(contact.first);  // the overlap is not above the face
  }
  return touch_along(pair, edges ? axes.edges : axes.face, settings.margin, columns, points);
}

PairContact touch(const ShapePair& pair, const TouchSettings& settings, PairMemory& memory,
                  ClipColumns& columns, std::vector<ContactPoint>& points) {
  if (!closer_than(pair, settings.margin)) return {};
  if (parted(pair, memory.axis, settings.margin)) return {};
  const std::optional<double> enough = enough_of_a_face(pair, settings, memory);
  if (!enough) return {};
  const ContactAxes axes = separating_axes(pair, *enough);
  if (axes.separation() > settings.margin) {
    memory.axis = axes.face.separation > settings.margin ? axes.face.normal : axes.edges.normal;
    return {};
  }
  return touch(pair, settings, axes, columns, points);
}

std::size_t touch_wall(const ConvexShape& shape, const Pose& pose, const Wall& wall, double margin,
                       std::vector<ContactPoint>& points) {
  const Vector& c = pose.centre;
  const UnitVector inward = wall.normal(c.x(), c.y(), c.z());
  const Vector normal = pose.orientation.conjugate() * Vector(inward.x, inward.y, inward.z);
  const double centre = wall.distance(c.x(), c.y(), c.z());
  const std::size_t before = points.size();
  for (const Vector& vertex : shape.vertices) {
    const double gap = centre + pose.scale * normal.dot(vertex);
    if (gap <= margin) points.push_back({pose.scale * vertex, gap});
  }
  return points.size() - before;
}

}  // namespace grainsweep
