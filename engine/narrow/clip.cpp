#include "engine/narrow/clip.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Shares of the sizes at hand: points this close to a side are inside, and corners this close to
// each other are one. Grains stacked edge on edge keep all of their corners.
constexpr double on_side = 1e-12;
constexpr double same_point = 1e-10;

// Square of the sine of an angle between edges below which rounding decides where they are closest:
// then the middle of the stretch that they share is taken.
constexpr double nearly_parallel = 1e-12;

const Face& face_of(const ConvexShape& shape, std::int32_t number) {
  return shape.faces[static_cast<std::size_t>(number)];
}

/// A face to touch on, in the frame of its shape.
struct Reference {
  const ConvexShape& shape;
  double scale = 1.0;
  const Face& face;
  double same = same_point;  ///< share of the size below which two points are one

  double size() const { return scale * shape.circumradius; }
  double gap(const Vector& x) const { return face.normal.dot(x) - scale * face.offset; }
  std::span<const Side> sides() const {
    return {shape.sides.data() + face.first, static_cast<std::size_t>(face.corners)};
  }
  double beyond(const Side& side, const Vector& x) const {
    return side.outward.dot(x) - scale * side.offset;
  }
  bool is_below(const Vector& x) const {
    const std::span<const Side> around = sides();
    return std::all_of(around.begin(), around.end(),
                       [&](const Side& side) { return beyond(side, x) <= on_side * size(); });
  }
};

/// Places the corners of a face.
void place_face(const SeenShape& other, const Face& face, std::vector<Vector>& corners) {
  corners.clear();
  for (const std::int32_t vertex : corners_of(other.shape, face)) {
    corners.push_back(other.place(vertex));
  }
}

/// Cuts a polygon by the plane through a side; how far each corner lies beyond it is given
/// (Sutherland and Hodgman 1974).
void cut(const std::vector<Vector>& polygon, const std::vector<double>& beyond, double tolerance,
         std::vector<Vector>& result) {
  result.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = k + 1 == polygon.size() ? 0 : k + 1;
    const double at_p = beyond[k], at_q = beyond[next];
    if (at_p <= tolerance) result.push_back(polygon[k]);
    if ((at_p <= tolerance) != (at_q <= tolerance)) {
      result.emplace_back(polygon[k] + at_p / (at_p - at_q) * (polygon[next] - polygon[k]));
    }
  }
}

/// A ball around all corners of a polygon of one or more.
struct Around {
  Vector centre = Vector::Zero();
  double radius = 0.0;
};
Around around(const std::vector<Vector>& polygon) {
  Around ball;
  for (const Vector& corner : polygon) ball.centre += corner;
  ball.centre /= static_cast<double>(polygon.size());
  double squared = 0.0;
  for (const Vector& corner : polygon) {
    squared = std::max(squared, (corner - ball.centre).squaredNorm());
  }
  ball.radius = std::sqrt(squared);
  return ball;
}

/// Cuts columns.polygon by all sides; most sides leave it as it is, many being far from it.
void cut_by_sides(const Reference& reference, ClipColumns& columns) {
  const double tolerance = on_side * reference.size();
  const Around ball = around(columns.polygon);
  for (const Side& side : reference.sides()) {
    if (reference.beyond(side, ball.centre) + ball.radius < 0.0) continue;
    double farthest = -infinity;
    columns.beyond.resize(columns.polygon.size());
    for (std::size_t k = 0; k < columns.polygon.size(); ++k) {
      columns.beyond[k] = reference.beyond(side, columns.polygon[k]);
      farthest = std::max(farthest, columns.beyond[k]);
    }
    if (farthest > tolerance) {
      cut(columns.polygon, columns.beyond, tolerance, columns.clipped);
      std::swap(columns.polygon, columns.clipped);
    }
  }
}

/// Among the faces at the lowest vertex of `other`, the one that faces `normal` most. Finds out how
/// far all vertices reach.
std::int32_t touching_face(const SeenShape& other, const Vector& normal, ClipColumns& columns) {
  const ConvexShape& shape = other.shape;
  const Vector down = -(other.turn.transpose() * normal);
  columns.reach.resize(shape.corner_columns.padded());
  const std::size_t lowest =
      columns.kernels->farthest(shape.corner_columns.columns(), down.data(), columns.reach.data());
  const auto first = shape.vertex_faces.begin() + shape.vertex_faces_begin[lowest];
  const auto last = shape.vertex_faces.begin() + shape.vertex_faces_begin[lowest + 1];
  return *std::max_element(first, last, [&](std::int32_t f, std::int32_t g) {
    return face_of(shape, f).normal.dot(down) < face_of(shape, g).normal.dot(down);
  });
}

void add_point(const Reference& reference, const Vector& x, double margin, std::size_t first,
               std::vector<ContactPoint>& points) {
  const double gap = reference.gap(x);
  if (!(gap <= margin)) return;
  const Vector position = x - gap / 2.0 * reference.face.normal;
  const double same = reference.same * reference.size();
  const auto known = std::find_if(points.begin() + static_cast<std::ptrdiff_t>(first), points.end(),
                                  [&](const ContactPoint& point) {
                                    return (point.position - position).squaredNorm() <= same * same;
                                  });
  if (known == points.end()) {
    points.push_back({position, gap});
  } else if (reference.same > same_point && gap < known->gap) {
    *known = {position, gap};
  }
}

/// What of `other` may touch beside its touching face, by how far its vertices reach.
struct Beside {
  const SeenShape& other;
  std::int32_t touching;
  std::span<const double> reach;  ///< of each vertex against the normal, d
  double least;                   ///< of those within the margin, d

  double reach_of(std::int32_t vertex) const { return reach[static_cast<std::size_t>(vertex)]; }
  bool has(std::size_t vertex) const {
    const ConvexShape& shape = other.shape;
    const auto first = shape.vertex_faces.begin() + shape.vertex_faces_begin[vertex];
    const auto last = shape.vertex_faces.begin() + shape.vertex_faces_begin[vertex + 1];
    return reach[vertex] >= least && std::find(first, last, touching) == last;
  }
  bool has(const Edge& edge) const {
    return std::min(reach_of(edge.from), reach_of(edge.to)) >= least && edge.left != touching &&
           edge.right != touching;
  }
  double rise(const Edge& edge) const { return std::abs(reach_of(edge.to) - reach_of(edge.from)); }
};

/// Vertices within the margin that are not corners of the touching face: where an edge lies on the
/// reference, a face at one of its ends may be the touching one, and would leave out the other end.
/// Whether there are any.
bool add_other_vertices(const Reference& reference, const Beside& beside, double margin,
                        std::size_t first, std::vector<ContactPoint>& points) {
  bool are_any = false;
  for (std::size_t v = 0; v < beside.other.shape.vertices.size(); ++v) {
    if (!beside.has(v)) continue;
    are_any = true;
    const Vector x = beside.other.place(static_cast<std::int32_t>(v));
    if (reference.is_below(x)) add_point(reference, x, margin, first, points);
  }
  return are_any;
}

/// Cuts a segment down to the part above the reference; false if there is none.
bool cut_by_sides(const Reference& reference, Vector& from, Vector& to) {
  const double tolerance = on_side * reference.size();
  for (const Side& side : reference.sides()) {
    const double at_from = reference.beyond(side, from), at_to = reference.beyond(side, to);
    const bool is_from_in = at_from <= tolerance, is_to_in = at_to <= tolerance;
    if (is_from_in && is_to_in) continue;
    if (!is_from_in && !is_to_in) return false;
    const Vector cut = from + at_from / (at_from - at_to) * (to - from);
    (is_from_in ? to : from) = cut;
  }
  return true;
}

/// Where edges that lie on the reference leave it, as such an edge and the touching face may share
/// no more than a corner, about which the grain would turn into the other. Steep edges matter only
/// once they lie on it.
void add_lying_edges(const Reference& reference, const Beside& beside, double margin,
                     std::size_t first, std::vector<ContactPoint>& points) {
  constexpr double lying = 0.02;  // rise by length: more than a grain turns in a step near rest
  for (const Edge& edge : beside.other.shape.edges) {
    if (!beside.has(edge)) continue;
    Vector from = beside.other.place(edge.from), to = beside.other.place(edge.to);
    if (beside.rise(edge) > lying * (to - from).norm()) continue;
    if (!cut_by_sides(reference, from, to)) continue;
    add_point(reference, from, margin, first, points);
    add_point(reference, to, margin, first, points);
  }
}

/// Appends the corners of a face of `other` cut by the sides of the reference.
void add_polygon(const Reference& reference, const SeenShape& other, const Face& face,
                 double margin, std::size_t first, ClipColumns& columns,
                 std::vector<ContactPoint>& points) {
  place_face(other, face, columns.polygon);
  cut_by_sides(reference, columns);
  for (const Vector& x : columns.polygon) add_point(reference, x, margin, first, points);
}

/// Appends the points on one face, those from `first` on being of the same contact.
void clip_on(const Reference& reference, const SeenShape& other, double margin, std::size_t first,
             ClipColumns& columns, std::vector<ContactPoint>& points) {
  const std::int32_t touching = touching_face(other, reference.face.normal, columns);
  add_polygon(reference, other, face_of(other.shape, touching), margin, first, columns, points);
  for (const std::int32_t beside : flat_with(other.shape, static_cast<std::size_t>(touching))) {
    add_polygon(reference, other, face_of(other.shape, beside), margin, first, columns, points);
  }
  const Beside others{other, touching, columns.reach, reference.gap(other.centre) - margin};
  // An edge that is none of the touching face has an end that is no corner of it.
  if (add_other_vertices(reference, others, margin, first, points)) {
    add_lying_edges(reference, others, margin, first, points);
  }
}

/// Appends the contact points on a face and on those nearly flat with it, in their frame.
void clip(const ConvexShape& shape, double scale, std::int32_t face, const SeenShape& other,
          double margin, ClipColumns& columns, std::vector<ContactPoint>& points) {
  // On an edge between such faces both give the same point, each along its own normal.
  constexpr double same_on_both = 1e-3;
  const std::size_t first = points.size();
  const auto beside = flat_with(shape, static_cast<std::size_t>(face));
  const double same = beside.empty() ? same_point : same_on_both;
  clip_on({shape, scale, face_of(shape, face), same}, other, margin, first, columns, points);
  for (const std::int32_t one : beside) {
    clip_on({shape, scale, face_of(shape, one), same}, other, margin, first, columns, points);
  }
}

}  // namespace

void clip_on_face(const ShapePair& pair, Of reference, std::int32_t face, double margin,
                  ClipColumns& columns, std::vector<ContactPoint>& points) {
  const PairPose& pose = pair.pose;
  if (reference == Of::a) {
    clip(pair.a, pose.scale_a, face, pair.b_from_a(), margin, columns, points);
    return;
  }
  const std::size_t first = points.size();
  clip(pair.b, pose.scale_b, face, pair.a_from_b(), margin, columns, points);
  for (std::size_t k = first; k < points.size(); ++k) {
    points[k].position = pose.centre + pose.turn * points[k].position;
  }
}

Segment farthest_edge(const ShapePair& pair, Of which, std::int32_t direction, const Vector& n) {
  const bool is_a = which == Of::a;
  Segment best{Vector::Zero(), Vector::Zero()};
  double reach = -infinity;
  for (const Edge& edge : (is_a ? pair.a : pair.b).edges) {
    if (edge.direction != direction) continue;
    const Segment segment = is_a ? Segment{pair.vertex_a(edge.from), pair.vertex_a(edge.to)}
                                 : Segment{pair.vertex_b(edge.from), pair.vertex_b(edge.to)};
    const double along = n.dot(segment.from + segment.to);
    if (along > reach) {
      reach = along;
      best = segment;
    }
  }
  return best;
}

Closeness closest_of(const Segment& p, const Segment& q) {
  const Vector u = p.to - p.from, v = q.to - q.from, w = p.from - q.from;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const auto within = [](double share) { return std::clamp(share, 0.0, 1.0); };
  const double crossed = uu * vv - uv * uv;  // by f64, nothing but rounding if nearly parallel
  const double on_p = crossed > nearly_parallel * uu * vv
                          ? within((uv * vw - vv * uw) / crossed)
                          : (within(-uw / uu) + within((uv - uw) / uu)) / 2.0;
  const double on_q = within((uv * on_p + vw) / vv);
  const double again = within((uv * on_q - uw) / uu);
  return {(p.from + again * u + q.from + on_q * v) / 2.0, (w + again * u - on_q * v).norm()};
}

}  // namespace grainsweep
