#include "engine/narrow/gjk.hpp"

#include <array>

#include "engine/narrow/separating_axes.hpp"

namespace grainsweep {

namespace {

// A support point that is closer to the origin by less than this share of the distance cannot be
// told from rounding.
constexpr double progress = 1e-14;
// Shares of the pair's size: closer to the origin counts as touching. The difference of two
// vertices is rounded to some 4e-16 of it.
constexpr double touching_share = 1e-14;
constexpr int max_iterations = 100;

/// Up to four corners of the Minkowski difference b - a and the weights of the point nearest to the
/// origin among them.
struct Corners {
  int count = 0;
  std::array<Vector, 4> at;
  std::array<std::int32_t, 4> a{}, b{};
  std::array<double, 4> weight{};

  Vector nearest() const {
    Vector sum = Vector::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) sum += weight[k] * at[k];
    return sum;
  }
  void add(const Corners& from, std::size_t k, double its_weight) {
    const auto next = static_cast<std::size_t>(count++);
    at[next] = from.at[k];
    a[next] = from.a[k];
    b[next] = from.b[k];
    weight[next] = its_weight;
  }
};

Corners only(const Corners& from, std::size_t k) {
  Corners one;
  one.add(from, k, 1.0);
  return one;
}

const Corners& nearer(const Corners& first, const Corners& second) {
  return second.nearest().squaredNorm() < first.nearest().squaredNorm() ? second : first;
}

/// Nearest point of the segment from corner i to corner j.
Corners nearest_of_segment(const Corners& c, std::size_t i, std::size_t j) {
  const Vector along = c.at[j] - c.at[i];
  const double length2 = along.squaredNorm();
  const double to_j = -c.at[i].dot(along), to_i = c.at[j].dot(along);
  if (!(length2 > 0.0) || to_j <= 0.0 || to_i <= 0.0) {
    return c.at[j].squaredNorm() < c.at[i].squaredNorm() ? only(c, j) : only(c, i);
  }
  Corners segment;
  segment.add(c, i, to_i / length2);
  segment.add(c, j, to_j / length2);
  return segment;
}

/// Signed areas of the triangles that the origin's projection makes with the sides of a triangle,
/// on the coordinate plane where the triangle is largest.
struct SignedAreas {
  double whole;
  std::array<double, 3> part;  ///< opposite to each corner
};

double signed_area(double px, double py, double qx, double qy, double rx, double ry) {
  return (qx - px) * (ry - py) - (qy - py) * (rx - px);
}

SignedAreas signed_areas(const Vector& s1, const Vector& s2, const Vector& s3, const Vector& n) {
  int largest = 0;
  n.cwiseAbs().maxCoeff(&largest);
  const int x = (largest + 1) % 3, y = (largest + 2) % 3;
  const Vector foot = s1.dot(n) / n.squaredNorm() * n;
  const auto area = [&](const Vector& p, const Vector& q, const Vector& r) {
    return signed_area(p[x], p[y], q[x], q[y], r[x], r[y]);
  };
  return {n[largest], {area(foot, s2, s3), area(s1, foot, s3), area(s1, s2, foot)}};
}

bool same_side(double a, double b) { return (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0); }

/// Nearest point of the triangle of corners i, j, k: within it if the origin's projection is on the
/// inner side of all sides, otherwise on one of the sides that it is beyond.
Corners nearest_of_triangle(const Corners& c, std::size_t i, std::size_t j, std::size_t k) {
  const std::array corner = {i, j, k};
  const Vector n = (c.at[j] - c.at[i]).cross(c.at[k] - c.at[i]);
  const bool flat = !(n.squaredNorm() > 0.0);
  const SignedAreas areas = flat ? SignedAreas{} : signed_areas(c.at[i], c.at[j], c.at[k], n);
  Corners best;
  for (std::size_t s = 0; s < 3; ++s) {
    if (same_side(areas.whole, areas.part[s])) continue;
    const Corners side = nearest_of_segment(c, corner[(s + 1) % 3], corner[(s + 2) % 3]);
    best = best.count == 0 ? side : nearer(best, side);
  }
  if (best.count > 0) return best;
  const double sum = areas.part[0] + areas.part[1] + areas.part[2];
  for (std::size_t s = 0; s < 3; ++s) best.add(c, corner[s], areas.part[s] / sum);
  return best;
}

/// Nearest point of the tetrahedron: the origin itself if it is on the inner side of all faces.
Corners nearest_of_tetrahedron(const Corners& c) {
  const auto volume = [](const Vector& p, const Vector& q, const Vector& r) {
    return p.dot(q.cross(r));
  };
  const auto& s = c.at;
  const std::array part = {volume(s[1], s[2], s[3]), -volume(s[0], s[2], s[3]),
                           volume(s[0], s[1], s[3]), -volume(s[0], s[1], s[2])};
  const double whole = part[0] + part[1] + part[2] + part[3];
  Corners best;
  for (std::size_t k = 0; k < 4; ++k) {
    if (same_side(whole, part[k])) continue;
    const Corners face = nearest_of_triangle(c, (k + 1) % 4, (k + 2) % 4, (k + 3) % 4);
    best = best.count == 0 ? face : nearer(best, face);
  }
  if (best.count > 0) return best;
  for (std::size_t k = 0; k < 4; ++k) best.add(c, k, part[k] / whole);
  return best;
}

Corners nearest_of(const Corners& c) {
  switch (c.count) {
    case 1:
      return only(c, 0);
    case 2:
      return nearest_of_segment(c, 0, 1);
    case 3:
      return nearest_of_triangle(c, 0, 1, 2);
    default:
      return nearest_of_tetrahedron(c);
  }
}

void add_corner(const ShapePair& pair, std::int32_t a, std::int32_t b, Corners& corners) {
  const auto k = static_cast<std::size_t>(corners.count++);
  corners.a[k] = a;
  corners.b[k] = b;
  corners.at[k] = pair.vertex_b(b) - pair.vertex_a(a);
}

/// The corner in the direction of the centres.
Corners first_corner(const ShapePair& pair) {
  Corners corners;
  const Vector& c = pair.pose.centre;
  add_corner(pair, farthest_vertex(pair.a, c),
             farthest_vertex(pair.b, -(pair.pose.turn.transpose() * c)), corners);
  return corners;
}

bool holds(const Corners& corners, std::int32_t a, std::int32_t b) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k) {
    if (corners.a[k] == a && corners.b[k] == b) return true;
  }
  return false;
}

struct Advance {
  bool is_nearer = false;
  bool parts = false;  ///< the direction of the nearest point parts the shapes
};

/// Adds the corner nearest to the origin along the current nearest point if it is nearer than that.
Advance advance(const ShapePair& pair, const Vector& nearest, Corners& corners) {
  const std::int32_t a = farthest_vertex(pair.a, nearest);
  const std::int32_t b = farthest_vertex(pair.b, -(pair.pose.turn.transpose() * nearest));
  const double length2 = nearest.squaredNorm();
  const double along = nearest.dot(pair.vertex_b(b) - pair.vertex_a(a));
  const bool is_nearer = !holds(corners, a, b) && length2 - along > progress * length2;
  if (is_nearer) add_corner(pair, a, b, corners);
  return {is_nearer, along > 0.0};
}

void set_witnesses(const ShapePair& pair, const Corners& corners, Closest& result) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(corners.count); ++k) {
    result.on_a += corners.weight[k] * pair.vertex_a(corners.a[k]);
    result.on_b += corners.weight[k] * pair.vertex_b(corners.b[k]);
  }
}

}  // namespace

Closest closest_points(const ShapePair& pair, const HullKernels& kernels) {
  const double touch = touching_share * pair.size();
  Corners best = nearest_of(first_corner(pair));
  Vector nearest = best.nearest();
  Closest result;
  int iterations = 1;
  for (; iterations <= max_iterations; ++iterations) {
    result.overlap = best.count == 4 || nearest.norm() <= touch;
    if (result.overlap) break;
    Corners next = best;
    const Advance advanced = advance(pair, nearest, next);
    if (advanced.is_nearer) next = nearest_of(next);
    const Vector moved = next.nearest();
    const bool is_inside = advanced.is_nearer && next.count == 4;
    if (!is_inside && !(moved.squaredNorm() < nearest.squaredNorm())) {
      // No further progress, at last because of rounding. For shapes that lie face on face or edge
      // on edge the corners can be a sliver, whose nearest point lies in a direction that does not
      // part the shapes.
      result.overlap = !advanced.parts && !(separating_axes(pair, kernels).separation() > 0.0);
      break;
    }
    best = next;
    nearest = moved;
  }
  result.converged = iterations <= max_iterations;
  result.distance = result.overlap ? 0.0 : nearest.norm();
  set_witnesses(pair, best, result);
  return result;
}

}  // namespace grainsweep
