#include "engine/narrow/separating_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace grainsweep {

namespace {

// Sine of the angle below which two edges are parallel: their cross product is rounding.
constexpr double parallel = 1e-14;
// Square of the sine above which a cross product is true to 1e-13, so that its bound can be
// trusted.
constexpr double well_crossed = 1e-6;

constexpr std::int32_t pinacoid_faces = 4, pinacoid_edges = 6;

const Vector& face_normal(const ConvexShape& shape, std::int32_t k) {
  return shape.faces[static_cast<std::size_t>(k)].normal;
}
const Vector& edge_direction(const ConvexShape& shape, std::int32_t k) {
  return shape.edge_directions[static_cast<std::size_t>(k)];
}

/// Axis along two edges' cross product, to rounding at right angles to both however small their
/// angle is: only the part of `v` at right angles to `u` is crossed. Zero if they are parallel.
Vector across(const Vector& u, const Vector& v) {
  const Vector n = u.cross(v - u.dot(v) * u);
  const double length = n.norm();
  return length > parallel ? Vector(n / length) : Vector(Vector::Zero());
}

/// How far the inner balls of two shapes reach together: a bound of every separation.
double inner_reach(const ShapePair& pair) {
  return pair.pose.scale_a * pair.a.inradius + pair.pose.scale_b * pair.b.inradius;
}

/// Takes `axis` if it parts the shapes better.
void keep_better(const ContactAxis& axis, ContactAxis& best) {
  if (best.kind == AxisKind::none || axis.separation > best.separation) best = axis;
}

// ---- pinacoids: both widths in closed form, so that the better sign of an axis is known ----

/// The axis n or -n, whichever points from a to b.
ContactAxis measured(const ShapePair& pair, const Vector& n) {
  const double along = n.dot(pair.pose.centre);
  ContactAxis axis;
  axis.normal = along < 0.0 ? Vector(-n) : n;
  axis.separation =
      std::abs(along) - pair.pose.scale_a * half_width(*pair.a.pinacoid, n) -
      pair.pose.scale_b * half_width(*pair.b.pinacoid, pair.pose.turn.transpose() * n);
  return axis;
}

ContactAxis pinacoid_face_of_a(const ShapePair& pair, std::int32_t k) {
  const Vector& n = face_normal(pair.a, k);
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::face_of_a;
  axis.a = axis.normal.dot(n) > 0.0 ? k : k + pinacoid_faces;
  return axis;
}

ContactAxis pinacoid_face_of_b(const ShapePair& pair, std::int32_t k) {
  const Vector n = pair.pose.turn * face_normal(pair.b, k);
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::face_of_b;
  axis.b = axis.normal.dot(n) < 0.0 ? k : k + pinacoid_faces;
  return axis;
}

/// The axis of edges i of a and j of b, which is v seen from a; kind none if they are parallel.
ContactAxis pinacoid_edges_axis(const ShapePair& pair, std::int32_t i, std::int32_t j,
                                const Vector& v) {
  const Vector n = across(edge_direction(pair.a, i), v);
  if (n.isZero(0.0)) return {};
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::edges;
  axis.a = i;
  axis.b = j;
  return axis;
}

/// Edges that part the shapes better than the best face, of all those that `wanted` allows: it is
/// given their cross product.
template <class Wanted>
ContactAxis pinacoid_better_edges(const ShapePair& pair, ContactAxis best, Wanted wanted) {
  for (std::int32_t j = 0; j < pinacoid_edges; ++j) {
    const Vector v = pair.pose.turn * edge_direction(pair.b, j);
    for (std::int32_t i = 0; i < pinacoid_edges; ++i) {
      if (!wanted(edge_direction(pair.a, i).cross(v), best.separation)) continue;
      const ContactAxis axis = pinacoid_edges_axis(pair, i, j, v);
      if (axis.kind != AxisKind::none && axis.separation > best.separation) best = axis;
    }
  }
  return best.kind == AxisKind::edges ? best : ContactAxis{};
}

/// All edges, but for those whose axis points so far aside that their inner balls overlap by more
/// along it.
ContactAxis pinacoid_better_edges(const ShapePair& pair, const ContactAxis& face) {
  const double inner = inner_reach(pair);
  return pinacoid_better_edges(pair, face, [&](const Vector& n, double best) {
    const double along = n.dot(pair.pose.centre), length2 = n.squaredNorm(), least = best + inner;
    return along * along > least * least * length2 || length2 < well_crossed || least <= 0.0;
  });
}

ContactAxis pinacoid_best_face(const ShapePair& pair) {
  ContactAxis best;
  for (std::int32_t k = 0; k < pinacoid_faces; ++k) {
    keep_better(pinacoid_face_of_a(pair, k), best);
  }
  for (std::int32_t k = 0; k < pinacoid_faces; ++k) {
    keep_better(pinacoid_face_of_b(pair, k), best);
  }
  return best;
}

// ---- any shapes ----

void try_axis(const ShapePair& pair, AxisKind kind, std::int32_t i, std::int32_t j, const Vector& n,
              ContactAxis& best) {
  const double bound = n.dot(pair.pose.centre) - inner_reach(pair);
  if (best.kind != AxisKind::none && bound <= best.separation) return;
  keep_better({kind, i, j, n, separation_along(pair, n)}, best);
}

ContactAxis best_face(const ShapePair& pair) {
  ContactAxis best;
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(pair.a.faces.size()); ++k) {
    try_axis(pair, AxisKind::face_of_a, k, -1, face_normal(pair.a, k), best);
  }
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(pair.b.faces.size()); ++k) {
    try_axis(pair, AxisKind::face_of_b, -1, k, -(pair.pose.turn * face_normal(pair.b, k)), best);
  }
  return best;
}

/// What bounds the separation along n from above: the inner balls of both shapes, and points of
/// b minus points of a, n . x of which it cannot exceed. The points are those that bounded the last
/// axes measured: an axis near one of those is mostly ruled out by its points.
struct Bounds {
  double inner = 0.0;
  std::array<Vector, 8> differences = {};
  std::size_t count = 0;

  void add(const Vector& difference) { differences[count++ % differences.size()] = difference; }

  /// Whether the axis along n, of any length, may part the shapes by more than `best`.
  bool allow(const Vector& n, double along, double best) const {
    const double length = n.norm(), least = best * length;
    if (along - inner * length <= least) return false;
    const auto known =
        differences.begin() + static_cast<std::ptrdiff_t>(std::min(count, differences.size()));
    return std::all_of(differences.begin(), known,
                       [&](const Vector& x) { return n.dot(x) > least; });
  }
};

/// Measures the axis n of two edges if it can be the best one.
void try_edges(const ShapePair& pair, std::int32_t i, std::int32_t j, const Vector& n,
               Bounds& bounds, ContactAxis& best) {
  if (!bounds.allow(n, n.dot(pair.pose.centre), best.separation)) return;
  const std::int32_t p = farthest_vertex(pair.a, n);
  const std::int32_t q = farthest_vertex(pair.b, -(pair.pose.turn.transpose() * n));
  const Vector difference = pair.vertex_b(q) - pair.vertex_a(p);
  bounds.add(difference);
  const double separation = n.dot(difference);
  if (separation > best.separation) best = {AxisKind::edges, i, j, n, separation};
}

/// The axes of edges that part the shapes better than their best face; none if there are none.
ContactAxis better_edges(const ShapePair& pair, double face_separation) {
  ContactAxis best;
  best.separation = face_separation;
  Bounds bounds{inner_reach(pair), {}, 0};
  for (std::int32_t j = 0; j < static_cast<std::int32_t>(pair.b.edge_directions.size()); ++j) {
    const Vector v = pair.pose.turn * edge_direction(pair.b, j);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(pair.a.edge_directions.size()); ++i) {
      const Vector& u = edge_direction(pair.a, i);
      const Vector rough = u.cross(v);
      const double along = rough.dot(pair.pose.centre);
      // Nearly parallel edges have a cross product too rough to be judged by.
      const bool sharp = rough.squaredNorm() > well_crossed;
      if (sharp && !bounds.allow(rough, along, best.separation) &&
          !bounds.allow(-rough, -along, best.separation)) {
        continue;
      }
      const Vector n = across(u, v);
      if (n.isZero(0.0)) continue;
      try_edges(pair, i, j, n, bounds, best);
      try_edges(pair, i, j, -n, bounds, best);
    }
  }
  return best.kind == AxisKind::none ? ContactAxis{} : best;
}

bool are_pinacoids(const ShapePair& pair) { return pair.a.pinacoid && pair.b.pinacoid; }

}  // namespace

double separation_along(const ShapePair& pair, const Vector& normal) {
  return normal.dot(pair.pose.centre) - pair.pose.scale_a * reach_along(pair.a, normal) -
         pair.pose.scale_b * reach_along(pair.b, -(pair.pose.turn.transpose() * normal));
}

ContactAxes separating_axes(const ShapePair& pair, double enough) {
  const bool closed = are_pinacoids(pair);
  const ContactAxis face = closed ? pinacoid_best_face(pair) : best_face(pair);
  if (face.separation >= enough) return {face, {}};
  return {face, closed ? pinacoid_better_edges(pair, face) : better_edges(pair, face.separation)};
}

bool parted_by(const PinacoidBlock& block, std::size_t lane, double margin, double scale) {
  const float separation = block.face_separation[lane] > block.edge_separation[lane]
                               ? block.face_separation[lane]
                               : block.edge_separation[lane];
  return static_cast<double>(separation) > margin + scale * static_cast<double>(pinacoid_rounding);
}

ContactAxes separating_axes(const ShapePair& pair, const PinacoidBlock& block, std::size_t lane) {
  constexpr std::int32_t first_edges = 2 * pinacoid_faces;
  constexpr double parallel_to_f32 = 2.0 * static_cast<double>(parallel_edges_sine2);
  const std::int32_t number = block.face_axis[lane], edges = block.edge_axis[lane] - first_edges;
  const std::int32_t i = edges / pinacoid_edges, j = edges % pinacoid_edges;
  const ContactAxis face = number < pinacoid_faces
                               ? pinacoid_face_of_a(pair, number)
                               : pinacoid_face_of_b(pair, number - pinacoid_faces);
  ContactAxis best = pinacoid_edges_axis(pair, i, j, pair.pose.turn * edge_direction(pair.b, j));
  if (best.kind == AxisKind::none || best.separation <= face.separation) best = face;
  if (block.edges_parallel[lane] != 0) {
    best = pinacoid_better_edges(
        pair, best, [](const Vector& n, double) { return n.squaredNorm() < parallel_to_f32; });
  }
  return {face, best.kind == AxisKind::edges ? best : ContactAxis{}};
}

}  // namespace grainsweep
