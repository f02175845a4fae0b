#include "engine/contact/separating_axes.hpp"

#include <cmath>

namespace grainsweep {

namespace {

// Sine of the angle below which two edges are parallel: their cross product is rounding.
constexpr double parallel = 1e-14;

constexpr std::int32_t pinacoid_faces = 4, pinacoid_edges = 6;

/// Axis along two edges' cross product, to rounding at right angles to both however small their
/// angle is: only the part of `v` at right angles to `u` is crossed. Zero if they are parallel.
Vector across(const Vector& u, const Vector& v) {
  const Vector n = u.cross(v - u.dot(v) * u);
  const double length = n.norm();
  return length > parallel ? Vector(n / length) : Vector(Vector::Zero());
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
  const Vector& n = pair.a.faces[static_cast<std::size_t>(k)].normal;
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::face_of_a;
  axis.a = axis.normal.dot(n) > 0.0 ? k : k + pinacoid_faces;
  return axis;
}

ContactAxis pinacoid_face_of_b(const ShapePair& pair, std::int32_t k) {
  const Vector n = pair.pose.turn * pair.b.faces[static_cast<std::size_t>(k)].normal;
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::face_of_b;
  axis.b = axis.normal.dot(n) < 0.0 ? k : k + pinacoid_faces;
  return axis;
}

/// Kind none if the edges are parallel.
ContactAxis pinacoid_edges_axis(const ShapePair& pair, std::int32_t i, std::int32_t j) {
  const Vector n = across(pair.a.edge_directions[static_cast<std::size_t>(i)],
                          pair.pose.turn * pair.b.edge_directions[static_cast<std::size_t>(j)]);
  if (n.isZero(0.0)) return {};
  ContactAxis axis = measured(pair, n);
  axis.kind = AxisKind::edges;
  axis.a = i;
  axis.b = j;
  return axis;
}

ContactAxes pinacoid_axes(const ShapePair& pair) {
  ContactAxes best;
  for (std::int32_t k = 0; k < pinacoid_faces; ++k) {
    keep_better(pinacoid_face_of_a(pair, k), best.face);
  }
  for (std::int32_t k = 0; k < pinacoid_faces; ++k) {
    keep_better(pinacoid_face_of_b(pair, k), best.face);
  }
  for (std::int32_t i = 0; i < pinacoid_edges; ++i) {
    for (std::int32_t j = 0; j < pinacoid_edges; ++j) {
      const ContactAxis axis = pinacoid_edges_axis(pair, i, j);
      if (axis.kind != AxisKind::none) keep_better(axis, best.edges);
    }
  }
  return best;
}

// ---- any shapes ----

/// Upper bound of the separation along n: neither shape reaches less far than its inner ball.
double most_along(const ShapePair& pair, const Vector& n) {
  return n.dot(pair.pose.centre) - pair.pose.scale_a * pair.a.inradius -
         pair.pose.scale_b * pair.b.inradius;
}

bool can_be_best(double bound, const ContactAxis& best) {
  return best.kind == AxisKind::none || bound > best.separation;
}

void try_axis(const ShapePair& pair, AxisKind kind, std::int32_t i, std::int32_t j, const Vector& n,
              ContactAxis& best) {
  if (!can_be_best(most_along(pair, n), best)) return;
  const double separation = separation_along(pair, n);
  if (can_be_best(separation, best)) best = {kind, i, j, n, separation};
}

ContactAxis best_face(const ShapePair& pair) {
  ContactAxis best;
  for (std::size_t k = 0; k < pair.a.faces.size(); ++k) {
    try_axis(pair, AxisKind::face_of_a, static_cast<std::int32_t>(k), -1, pair.a.faces[k].normal,
             best);
  }
  for (std::size_t k = 0; k < pair.b.faces.size(); ++k) {
    try_axis(pair, AxisKind::face_of_b, -1, static_cast<std::int32_t>(k),
             -(pair.pose.turn * pair.b.faces[k].normal), best);
  }
  return best;
}

ContactAxis best_edges(const ShapePair& pair) {
  ContactAxis best;
  for (std::size_t j = 0; j < pair.b.edge_directions.size(); ++j) {
    const Vector v = pair.pose.turn * pair.b.edge_directions[j];
    for (std::size_t i = 0; i < pair.a.edge_directions.size(); ++i) {
      const Vector n = across(pair.a.edge_directions[i], v);
      if (n.isZero(0.0)) continue;
      const auto a = static_cast<std::int32_t>(i), b = static_cast<std::int32_t>(j);
      try_axis(pair, AxisKind::edges, a, b, n, best);
      try_axis(pair, AxisKind::edges, a, b, -n, best);
    }
  }
  return best;
}

bool are_pinacoids(const ShapePair& pair) { return pair.a.pinacoid && pair.b.pinacoid; }

}  // namespace

double separation_along(const ShapePair& pair, const Vector& normal) {
  return normal.dot(pair.pose.centre) - pair.pose.scale_a * reach_along(pair.a, normal) -
         pair.pose.scale_b * reach_along(pair.b, -(pair.pose.turn.transpose() * normal));
}

ContactAxes separating_axes(const ShapePair& pair) {
  return are_pinacoids(pair) ? pinacoid_axes(pair) : ContactAxes{best_face(pair), best_edges(pair)};
}

bool parted_by(const PinacoidBlock& block, std::size_t lane, double margin, double scale) {
  const float separation = block.face_separation[lane] > block.edge_separation[lane]
                               ? block.face_separation[lane]
                               : block.edge_separation[lane];
  return static_cast<double>(separation) > margin + scale * static_cast<double>(pinacoid_rounding);
}

ContactAxes separating_axes(const ShapePair& pair, const PinacoidBlock& block, std::size_t lane) {
  if (block.edges_parallel[lane] != 0) return pinacoid_axes(pair);
  constexpr std::int32_t first_edges = 2 * pinacoid_faces;
  const std::int32_t face = block.face_axis[lane], edges = block.edge_axis[lane] - first_edges;
  return {face < pinacoid_faces ? pinacoid_face_of_a(pair, face)
                                : pinacoid_face_of_b(pair, face - pinacoid_faces),
          pinacoid_edges_axis(pair, edges / pinacoid_edges, edges % pinacoid_edges)};
}

}  // namespace grainsweep
