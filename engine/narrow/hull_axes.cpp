// Separating axes of any two hulls, and what is kept of the search while they hardly move.
//
// Along a fixed direction a separation changes by no more than points of the other shape have
// moved. So where the two have moved by less than half of `slack` since a search, a face that was
// worse than the best one by `slack` still is worse; edges between whose faces no axis could part
// the shapes by as much still have none; and edges whose arcs were further from crossing than they
// have turned still do not cross. The candidates are all others.
#include <algorithm>

#include "engine/narrow/axes.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Share of the pair's size by which the axis found may be the second best.
constexpr double same_depth = 1e-14;
// Cosines this small have no sign.
constexpr double no_sign = 1e-12;

/// A pair as one of its shapes sees it, in its own frame. Corners of the other shape, learnt one by
/// one, bound how far faces and edges can part the two.
struct View {
  const HullKernels& kernels;
  const ConvexShape& shape;
  double scale = 1.0;
  SeenShape other;
  CornerHeights& known;

  std::size_t stride() const { return shape.normal_columns.padded(); }
  void forget() {
    known.corners.clear();
    known.heights.clear();
    known.least.assign(stride(), infinity);
  }
  /// The corner that is lowest along n.
  std::int32_t lowest(const Vector& n) {
    const VectorColumns& corners = other.shape.corner_columns;
    known.reach.resize(corners.padded());
    const Vector down = -(other.turn.transpose() * n);
    return static_cast<std::int32_t>(
        kernels.farthest(corners.columns(), down.data(), known.reach.data()));
  }
  /// How far a face parts the shapes.
  double separation(std::int32_t number) {
    const Face& face = shape.faces[static_cast<std::size_t>(number)];
    return face.normal.dot(other.place(lowest(face.normal))) - scale * face.offset;
  }
  /// Learns the corner that is lowest along n, and returns its heights over the faces.
  const double* add_lowest(const Vector& n) {
    const std::int32_t corner = lowest(n);
    const auto at = std::find(known.corners.begin(), known.corners.end(), corner);
    const auto first = static_cast<std::size_t>(at - known.corners.begin()) * stride();
    if (at == known.corners.end()) add(corner);
    return known.heights.data() + first;
  }
  void add(std::int32_t corner) {
    const Vector x = other.place(corner);
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

/// The axis of a face of either.
ContactAxis axis_of_a(const ShapePair& pair, std::int32_t face, double separation) {
  return {AxisKind::face_of_a, face, -1, face_normal(pair.a, face), separation};
}
ContactAxis axis_of_b(const ShapePair& pair, std::int32_t face, double separation) {
  const Vector normal = -(pair.pose.turn * face_normal(pair.b, face));
  return {AxisKind::face_of_b, -1, face, normal, separation};
}

ContactAxis best_face(const ShapePair& pair, View& a, View& b) {
  double best = -infinity;
  const std::int32_t of_a = better_face(a, best), of_b = better_face(b, best);
  return of_b < 0 ? axis_of_a(pair, of_a, best) : axis_of_b(pair, of_b, best);
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

/// How the edges placed cross one of b.
void find_crossings(const HullKernels& kernels, const HullEdge& other, double in_doubt,
                    PlacedEdges& of_a) {
  kernels.crossings(
      {of_a.from.columns(), of_a.along.columns(), of_a.left.columns(), of_a.right.columns()}, other,
      in_doubt, parallel, of_a.parted.data(), of_a.crossings.data());
}

/// Takes the axis n of edges p of a and q of b if it parts the shapes better.
void try_edges(const ShapePair& pair, const Edge& p, const Edge& q, const Vector& n,
               ContactAxis& best) {
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
  find_crossings(kernels, other, no_sign, of_a);
  const Eigen::Map<const Vector> along(other.along);
  for (std::size_t k = 0; k < of_a.edges.size(); ++k) {
    const std::uint8_t crossing = of_a.crossings[k];
    if (crossing == no_crossing) continue;
    const double parted = of_a.parted[k];
    const Edge& p = *of_a.edges[k];
    if ((crossing & along_product) != 0 && parted > best.separation) {
      try_edges(pair, p, q, across(p.along, along), best);
    }
    if ((crossing & against_product) != 0 && -parted > best.separation) {
      try_edges(pair, p, q, -across(p.along, along), best);
    }
  }
}

/// The same for one edge of each.
void try_crossing(const ShapePair& pair, const Edge& p, const Edge& q, ContactAxis& best) {
  const Matrix& turn = pair.pose.turn;
  const Vector along = turn * q.along;
  const double to_left = along.dot(face_normal(pair.a, p.left));
  const double to_right = along.dot(face_normal(pair.a, p.right));
  const double from_left = p.along.dot(turn * face_normal(pair.b, q.left));
  const double from_right = p.along.dot(turn * face_normal(pair.b, q.right));
  const Vector n = across(p.along, along);
  const double parted = n.dot(pair.vertex_b(q.from) - pair.vertex_a(p.from));
  for (const double sign : {1.0, -1.0}) {
    const bool crosses = sign * to_left >= -no_sign && sign * to_right <= no_sign &&
                         sign * from_left >= -no_sign && sign * from_right <= no_sign;
    if (crosses && sign * parted > best.separation) try_edges(pair, p, q, sign * n, best);
  }
}

/// The axes of edges that part the shapes better than their best face; kind none if there are none.
ContactAxis better_edges(const ShapePair& pair, View& a, View& b, double face, PlacedEdges& of_a) {
  const double least = std::min(face, 0.0) + same_depth * pair.size();
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

// ---- candidates ----

// Axes worse than the best one by this much are left out, as a share of the pair's size and as a
// cosine.
constexpr double slack_of_size = 0.02, slack_of_cosine = 0.02;
// Candidates are listed where the pair has moved by this share or less since its last search: they
// then hold for several steps.
constexpr double slow_share = 1.0 / 16.0;

/// Share of the slack that a pair has used since the pose of its candidates; they hold below a
/// half.
double slack_used(const ShapePair& pair, const AxisCandidates& candidates) {
  if (!candidates.is_set) return infinity;
  const Eigen::Map<const Vector> centre(candidates.centre);
  const Eigen::Map<const Matrix> turn(candidates.turn);
  const double turned = (pair.pose.turn - turn).norm(), size = pair.size();
  // No point of either shape, seen from the other one, has moved by more.
  const double moved = (pair.pose.centre - centre).norm() + turned * (size + centre.norm());
  return std::max(moved / (slack_of_size * size), turned / slack_of_cosine);
}

/// The faces that part the shapes by more than `limit`; false if there are too many.
bool list_faces(View& view, double limit, bool of_a, AxisCandidates& candidates) {
  std::vector<double>& least = view.known.least;
  for (;;) {
    const std::size_t k = view.kernels.largest(least.data(), view.shape.faces.size());
    if (!(least[k] > limit)) return true;
    const double separation = view.add_lowest(view.shape.faces[k].normal)[k];
    least[k] = -infinity;
    if (!(separation > limit)) continue;
    if (candidates.faces == AxisCandidates::most_faces) return false;
    const auto number = static_cast<std::int16_t>(k);
    candidates.face[candidates.faces++] = of_a ? number : static_cast<std::int16_t>(-1 - number);
  }
}

/// The pairs of edges that may part the shapes by more than `limit`; false if there are too many.
bool list_edges(const ShapePair& pair, View& a, View& b, double limit, PlacedEdges& of_a,
                AxisCandidates& candidates) {
  a.sink(limit);
  b.sink(limit);
  place_edges(pair, a, of_a);
  if (of_a.edges.empty()) return true;
  for (const Edge& q : pair.b.edges) {
    if (!b.may_part(q)) continue;
    find_crossings(a.kernels, edge_of_b(pair, q), slack_of_cosine, of_a);
    for (std::size_t k = 0; k < of_a.edges.size(); ++k) {
      if (of_a.crossings[k] == no_crossing) continue;
      if (candidates.edges == AxisCandidates::most_edges) return false;
      candidates.edge_of_a[candidates.edges] =
          static_cast<std::int16_t>(of_a.edges[k] - pair.a.edges.data());
      candidates.edge_of_b[candidates.edges++] =
          static_cast<std::int16_t>(&q - pair.b.edges.data());
    }
  }
  return true;
}

void set_pose(const PairPose& pose, AxisCandidates& candidates) {
  Eigen::Map<Vector>(candidates.centre) = pose.centre;
  Eigen::Map<Matrix>(candidates.turn) = pose.turn;
  candidates.is_set = true;
}

/// After a search: lists the candidates if the pair has hardly moved since the last one.
void list_candidates(const ShapePair& pair, View& a, View& b, double face, double used,
                     PlacedEdges& of_a, AxisCandidates& candidates) {
  if (candidates.are_too_many && used < 0.5) return;
  candidates = {};
  set_pose(pair.pose, candidates);
  if (used > slow_share) return;
  const double slack = slack_of_size * pair.size();
  candidates.is_listed = list_faces(a, face - slack, true, candidates) &&
                         list_faces(b, face - slack, false, candidates) &&
                         list_edges(pair, a, b, std::min(face, 0.0) - slack, of_a, candidates);
  candidates.are_too_many = !candidates.is_listed;
}

/// The axis of face k of a, or -1 - k of b.
ContactAxis face_axis(const ShapePair& pair, View& a, View& b, std::int32_t k) {
  const bool of_a = k >= 0;
  const std::int32_t face = of_a ? k : -1 - k;
  return of_a ? axis_of_a(pair, face, a.separation(face))
              : axis_of_b(pair, face, b.separation(face));
}

/// The best of the candidates.
ContactAxes axes_among(const ShapePair& pair, View& a, View& b, const AxisCandidates& candidates) {
  ContactAxis face, edges;
  for (std::size_t k = 0; k < candidates.faces; ++k) {
    const ContactAxis axis = face_axis(pair, a, b, candidates.face[k]);
    if (face.kind == AxisKind::none || axis.separation > face.separation) face = axis;
  }
  edges.separation = face.separation;
  for (std::size_t k = 0; k < candidates.edges; ++k) {
    const Edge& p = pair.a.edges[static_cast<std::size_t>(candidates.edge_of_a[k])];
    const Edge& q = pair.b.edges[static_cast<std::size_t>(candidates.edge_of_b[k])];
    try_crossing(pair, p, q, edges);
  }
  return {face, edges.kind == AxisKind::none ? ContactAxis{} : edges};
}

}  // namespace

ContactAxes hull_axes(const ShapePair& pair, const Vector& guess, AxisCandidates& candidates,
                      AxisColumns& columns) {
  const PairPose& pose = pair.pose;
  const HullKernels& kernels = *columns.kernels;
  View a{kernels, pair.a, pose.scale_a, pair.b_from_a(), columns.over_a};
  View b{kernels, pair.b, pose.scale_b, pair.a_from_b(), columns.over_b};
  const double used = slack_used(pair, candidates);
  if (candidates.is_listed && used < 0.5) return axes_among(pair, a, b, candidates);
  const Matrix back = pose.turn.transpose();
  const Vector axis = guess.isZero(0.0) ? pose.centre : guess;
  a.forget();
  b.forget();
  a.add_lowest(axis);
  b.add_lowest(-(back * axis));
  const ContactAxis face = best_face(pair, a, b);
  const ContactAxis edges = better_edges(pair, a, b, face.separation, columns.edges_of_a);
  list_candidates(pair, a, b, face.separation, used, columns.edges_of_a, candidates);
  return {face, edges};
}

}  // namespace grainsweep
