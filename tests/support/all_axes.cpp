#include "tests/support/all_axes.hpp"

namespace grainsweep::testing {

namespace {

void keep_better(const ShapePair& pair, AxisKind kind, std::size_t i, std::size_t j,
                 const Vector& n, ContactAxis& best) {
  const double separation = separation_along(pair, n);
  if (best.kind == AxisKind::none || separation > best.separation) {
    best = {kind, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), n, separation};
  }
}

ContactAxis best_face(const ShapePair& pair) {
  ContactAxis best;
  for (std::size_t k = 0; k < pair.a.faces.size(); ++k) {
    keep_better(pair, AxisKind::face_of_a, k, 0, pair.a.faces[k].normal, best);
  }
  for (std::size_t k = 0; k < pair.b.faces.size(); ++k) {
    const Vector n = -(pair.pose.turn * pair.b.faces[k].normal);
    keep_better(pair, AxisKind::face_of_b, 0, k, n, best);
  }
  return best;
}

ContactAxis best_edges(const ShapePair& pair) {
  ContactAxis best;
  for (std::size_t j = 0; j < pair.b.edge_directions.size(); ++j) {
    const Vector v = pair.pose.turn * pair.b.edge_directions[j];
    for (std::size_t i = 0; i < pair.a.edge_directions.size(); ++i) {
      const Vector& u = pair.a.edge_directions[i];
      const Vector n = u.cross(v - u.dot(v) * u);
      if (n.norm() <= 1e-14) continue;  // parallel
      keep_better(pair, AxisKind::edges, i, j, n.normalized(), best);
      keep_better(pair, AxisKind::edges, i, j, -n.normalized(), best);
    }
  }
  return best;
}

}  // namespace

ContactAxes all_axes(const ShapePair& pair) {
  const ContactAxis face = best_face(pair), edges = best_edges(pair);
  const bool better = edges.kind != AxisKind::none && edges.separation > face.separation;
  return {face, better ? edges : ContactAxis{}};
}

}  // namespace grainsweep::testing
