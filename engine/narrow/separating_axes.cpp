#include "engine/narrow/separating_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

// Share of the pair's size by which the axis found may be the second best.
constexpr double same_depth = 1e-14;
// Cosines this small have no sign.
constexpr double no_sign = 1e-12;

/// A pair as one of its shapes sees it, in its own frame. Corners of the other shape, learnt one by
/// one, bound how far faces and edges can part the two.
struct View {
  const HullKernels& kernels;
  const ConvexShape& shape;
  double scale;
  const ConvexShape& other;  ///< its point x lies at centre + turn x
  Vector centre;
  Matrix turn;  ///< and scale
  CornerHeights& known;

  std::size_t stride() const { return shape.normal_columns.padded(); }
  void forget() {
    known.corners.clear();
    known.heights.clear();
    known.least.assign(stride(), std::numeric_limits<double>::infinity());
    known.reach.resize(other.corner_columns.padded());
  }
  /// Learns the corner that is lowest along n, and returns its heights over the faces.
  const double* add_lowest(const Vector& n) {
    const Vector down = -(turn.transpose() * n);
    const auto corner = static_cast<std::int32_t>(
        kernels.farthest(other.corner_columns.columns(), down.data(), known.reach.data()));
    const auto at = std::find(known.corners.begin(), known.corners.end(), corner);
    const auto first = static_cast<std::size_t>(at - known.corners.begin()) * stride();
    if (at == known.corners.end()) add(corner);
    return known.heights.data() + first;
  }
  void add(std::int32_t corner) {
    const Vector x = centre + turn * other.vertices[static_cast<std::size_t>(corner)];
    const std::size_t first = known.heights.size();
    known.corners.push_back(corner);
    known.heights.resize(first + stride());
    kernels.heights({shape.normal_columns.columns(), shape.offset_columns.data()}, scale, x.data(),
                    known.heights.data() + first, known.least.data());
  }
  /// Finds out which corners lie no higher than `best` <= 0 over each face.
  void sink(double best) {
    known.below.resize(stride());
    kernels.below(known.heights.data(), stride(), known.corners.size(), best, known.below.data());
  }
  /// Whether an axis between the normals of the faces at an edge may part the shapes by more than
  /// that. It cannot if a corner lies that deep below both faces: the normals between are their
  /// sums with weights of together 1 or more.
  bool may_part(const Edge& edge) const {
    return (known.below[static_cast<std::size_t>(edge.left)] &
            known.below[static_cast<std::size_t>(edge.right)]) == 0;
  }
};

/// The face of the view's shape that parts the shapes by more than `best`, and by the most; -1 if
/// none does. `best` is its separation then. Faces that may do so by the corners known are measured
/// in the order of what those allow.
std::int32_t better_face(View& view, double& best) {
  std::int32_t found = -1;
  for (;;) {
    std::vector<double>& least = view.known.least;
    const std::size_t k = view.kernels.largest(least.data(), view.shape.faces.size());
    if (!(least[k] > best)) return found;
    least[k] = view.add_lowest(view.shape.faces[k].normal)[k];
    if (least[k] > best) {
      best = least[k];
      found = static_cast<std::int32_t>(k);
    }
  }
}

ContactAxis best_face(const ShapePair& pair, View& a, View& b) {
  double best = -std::numeric_limits<double>::infinity();
  const std::int32_t of_a = better_face(a, best), of_b = better_face(b, best);
  if (of_b < 0) return {AxisKind::face_of_a, of_a, -1, face_normal(pair.a, of_a), best};
  return {AxisKind::face_of_b, -1, of_b, -(pair.pose.turn * face_normal(pair.b, of_b)), best};
}

/// Places the edges of a that may part the shapes.
void place_edges(const ShapePair& pair, const View& a, PlacedEdges& placed) {
  for (VectorColumns* column : {&placed.from, &placed.along, &placed.left, &placed.right}) {
    column->clear();
  }
  placed.edges.clear();
  for (const Edge& edge : a.shape.edges) {
    if (!a.may_part(edge)) continue;
    placed.from.add(pair.vertex_a(edge.from));
    placed.along.add(edge.along);
    placed.left.add(face_normal(a.shape, edge.left));
    placed.right.add(face_normal(a.shape, edge.right));
    placed.edges.push_back(&edge);
  }
  placed.crossings.resize(placed.along.padded());
  placed.parted.resize(placed.along.padded());
}

HullEdge edge_of_b(const ShapePair& pair, const Edge& edge) {
  const Matrix& turn = pair.pose.turn;
  HullEdge placed{};
  Eigen::Map<Vector>(placed.from) = pair.vertex_b(edge.from);
  Eigen::Map<Vector>(placed.along) = turn * edge.along;
  Eigen::Map<Vector>(placed.left) = turn * face_normal(pair.b, edge.left);
  Eigen::Map<Vector>(placed.right) = turn * face_normal(pair.b, edge.right);
  return placed;
}

/// Takes the axis of edges p of a and q of b, which is `along`, times `sign` if it parts the shapes
/// better.
void try_edges(const ShapePair& pair, const Edge& p, const Edge& q, const Vector& along,
               double sign, ContactAxis& best) {
  const Vector n = sign * across(p.along, along);
  if (n.isZero(0.0)) return;
  const double separation = separation_along(pair, n);
  if (separation > best.separation) {
    best = {AxisKind::edges, p.direction, q.direction, n, separation};
  }
}

/// Tries an edge of b with those of a that it crosses: only where the axis lies between the normals
/// at both edges do they make a face of the difference of the shapes (Gauss map; Gregorius 2013).
/// What is in doubt is tried, too.
void try_edges(const ShapePair& pair, const HullKernels& kernels, PlacedEdges& of_a, const Edge& q,
               ContactAxis& best) {
  const HullEdge other = edge_of_b(pair, q);
  kernels.crossings(
      {of_a.from.columns(), of_a.along.columns(), of_a.left.columns(), of_a.right.columns()}, other,
      no_sign, parallel, of_a.parted.data(), of_a.crossings.data());
  const Eigen::Map<const Vector> along(other.along);
  for (std::size_t k = 0; k < of_a.edges.size(); ++k) {
    const std::uint8_t crossing = of_a.crossings[k];
    if (crossing == no_crossing) continue;
    const double parted = of_a.parted[k];
    const Edge& p = *of_a.edges[k];
    if ((crossing & along_product) != 0 && parted > best.separation) {
      try_edges(pair, p, q, along, 1.0, best);
    }
    if ((crossing & against_product) != 0 && -parted > best.separation) {
      try_edges(pair, p, q, along, -1.0, best);
    }
  }
}

/// The axes of edges that part the shapes better than their best face; kind none if there are none.
ContactAxis better_edges(const ShapePair& pair, View& a, View& b, double face, PlacedEdges& of_a) {
  const double size =
      pair.pose.scale_a * pair.a.circumradius + pair.pose.scale_b * pair.b.circumradius;
  const double least = std::min(face, 0.0) + same_depth * size;
  a.sink(least);
  place_edges(pair, a, of_a);
  if (of_a.edges.empty()) return {};
  b.sink(least);
  ContactAxis best;
  best.separation = face;
  for (const Edge& edge : pair.b.edges) {
    if (b.may_part(edge)) try_edges(pair, a.kernels, of_a, edge, best);
  }
  return best.kind == AxisKind::none ? ContactAxis{} : best;
}

ContactAxes hull_axes(const ShapePair& pair, const Vector& guess, AxisColumns& columns) {
  const PairPose& pose = pair.pose;
  const Matrix back = pose.turn.transpose();
  const HullKernels& kernels = *columns.kernels;
  View a{kernels,       pair.a, pose.scale_a, pair.b, pose.centre, pose.scale_b * pose.turn,
         columns.over_a};
  View b{kernels,       pair.b, pose.scale_b, pair.a, -(back * pose.centre), pose.scale_a * back,
         columns.over_b};
  const Vector axis = guess.isZero(0.0) ? pose.centre : guess;
  a.forget();
  b.forget();
  a.add_lowest(axis);
  b.add_lowest(-(back * axis));
  const ContactAxis face = best_face(pair, a, b);
  return {face, better_edges(pair, a, b, face.separation, columns.edges_of_a)};
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

ContactAxes separating_axes(const ShapePair& pair, const Vector& guess, AxisColumns& columns) {
  const bool closed = pair.a.pinacoid && pair.b.pinacoid;
  return closed ? pinacoid_axes(pair) : hull_axes(pair, guess, columns);
}

ContactAxes separating_axes(const ShapePair& pair) {
  AxisColumns columns;
  return separating_axes(pair, Vector::Zero(), columns);
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
