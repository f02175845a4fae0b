#include "engine/narrow/separating_axes.hpp"

#include <cmath>

#include "engine/narrow/axes.hpp"

namespace grainsweep {

namespace {

// Square of the sine above which a cross product is accurate to 1e-13, so that its bound can be
// trusted.
constexpr double well_crossed = 1e-6;

constexpr std::int32_t pinacoid_faces = 4, pinacoid_edges = 6;

const Vector& edge_direction(const ConvexShape& shape, std::int32_t k) {
  return shape.edge_directions[static_cast<std::size_t>(k)];
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

/// Edges that part the shapes better than the best face, of all those that `wanted`, given their
/// cross product, allows.
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

ContactAxes pinacoid_axes(const ShapePair& pair) {
  const ContactAxis face = pinacoid_best_face(pair);
  return {face, pinacoid_better_edges(pair, face)};
}

}  // namespace

double separation_along(const ShapePair& pair, const Vector& normal) {
  return normal.dot(pair.pose.centre) - pair.pose.scale_a * reach_along(pair.a, normal) -
         pair.pose.scale_b * reach_along(pair.b, -(pair.pose.turn.transpose() * normal));
}

ContactAxes separating_axes(const ShapePair& pair, const Vector& guess, AxisCandidates& candidates,
                            AxisColumns& columns) {
  const bool closed = pair.a.pinacoid && pair.b.pinacoid;
  return closed ? pinacoid_axes(pair) : hull_axes(pair, guess, candidates, columns);
}

ContactAxes separating_axes(const ShapePair& pair, const HullKernels& kernels) {
  AxisColumns columns;
  columns.kernels = &kernels;
  AxisCandidates none;
  return separating_axes(pair, Vector::Zero(), none, columns);
}

double parted_by(const PinacoidBlock& block, std::size_t lane, double reach) {
  const float separation = block.face_separation[lane] > block.edge_separation[lane]
                               ? block.face_separation[lane]
                               : block.edge_separation[lane];
  return static_cast<double>(separation) - reach * static_cast<double>(pinacoid_rounding);
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
