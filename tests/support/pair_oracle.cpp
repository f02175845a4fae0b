#include "tests/support/pair_oracle.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

namespace grainsweep::testing {

namespace {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;

/// A grain placed in the frame of a.
struct Solid {
  const ConvexShape& shape;
  std::vector<Point> vertices;
  std::vector<Point> normals;
};

Solid solid(const ConvexShape& shape, const Vector& centre, const Matrix& turn, double scale) {
  Solid placed{shape, {}, {}};
  for (const Vector& v : shape.vertices) {
    const Point x = turn.cast<Real>() * v.cast<Real>();
    placed.vertices.emplace_back(centre.cast<Real>() + Real(scale) * x);
  }
  for (const Face& face : shape.faces) {
    Point area = Point::Zero();
    const auto corner = [&](int k) {
      return placed.vertices[static_cast<std::size_t>(
          shape.loops[static_cast<std::size_t>(face.first + k)])];
    };
    for (int k = 1; k + 1 < face.corners; ++k) {
      area += (corner(k) - corner(0)).cross(corner(k + 1) - corner(0));
    }
    placed.normals.emplace_back(area.normalized());
  }
  return placed;
}

Real separation(const Solid& a, const Solid& b, const Point& n) {
  Real most = n.dot(a.vertices[0]), least = n.dot(b.vertices[0]);
  for (const Point& v : a.vertices) most = std::max(most, n.dot(v));
  for (const Point& v : b.vertices) least = std::min(least, n.dot(v));
  return least - most;
}

Point along(const Solid& solid, const Edge& edge) {
  return solid.vertices[static_cast<std::size_t>(edge.to)] -
         solid.vertices[static_cast<std::size_t>(edge.from)];
}

struct Separations {
  Real any, well_conditioned;
};

Separations largest_separation(const Solid& a, const Solid& b) {
  Real best = -std::numeric_limits<Real>::infinity();
  for (const Point& n : a.normals) best = std::max(best, separation(a, b, n));
  for (const Point& n : b.normals) best = std::max(best, separation(a, b, -n));
  Separations found{best, best};
  for (const Edge& e : a.shape.edges) {
    const Point u = along(a, e).normalized();
    for (const Edge& f : b.shape.edges) {
      const Point v = along(b, f).normalized(), n = u.cross(v - u.dot(v) * u);
      const Real sine = n.norm();
      if (sine < 1e-17L) continue;
      const Real here = std::max(separation(a, b, n / sine), separation(a, b, -n / sine));
      found.any = std::max(found.any, here);
      if (sine > 1e-3L) found.well_conditioned = std::max(found.well_conditioned, here);
    }
  }
  return found;
}

Real to_segment(const Point& x, const Point& p, const Point& q) {
  const Point u = q - p;
  const Real t = std::clamp((x - p).dot(u) / u.squaredNorm(), Real(0), Real(1));
  return (x - p - t * u).norm();
}

/// An end is closest, or the point of one line that is closest to the other: projected once more,
/// as for nearly parallel lines it is known much better across them than along them.
Real between_segments(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Point u = q - p, v = s - r, w = p - r;
  const Real uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uw = u.dot(w), vw = v.dot(w);
  const Real det = uu * vv - uv * uv;
  const Real t = det > 0 ? std::clamp((uv * vw - vv * uw) / det, Real(0), Real(1)) : 0;
  return std::min({to_segment(p, r, s), to_segment(q, r, s), to_segment(r, p, q),
                   to_segment(s, p, q), to_segment(p + t * u, r, s)});
}

/// Distances of vertices of `a` from the faces of `b` that they project onto.
Real vertices_to_faces(const Solid& a, const Solid& b) {
  Real best = std::numeric_limits<Real>::infinity();
  for (std::size_t f = 0; f < b.normals.size(); ++f) {
    const Face& face = b.shape.faces[f];
    const auto corner = [&](int k) -> const Point& {
      return b.vertices[static_cast<std::size_t>(
          b.shape.loops[static_cast<std::size_t>(face.first + k % face.corners)])];
    };
    for (const Point& x : a.vertices) {
      const Real height = b.normals[f].dot(x - corner(0));
      bool above = height >= 0;
      for (int k = 0; k < face.corners && above; ++k) {
        const Point side = corner(k + 1) - corner(k);
        above = side.cross(b.normals[f]).dot(x - corner(k)) <= 0;
      }
      if (above) best = std::min(best, height);
    }
  }
  return best;
}

Real closest_features(const Solid& a, const Solid& b) {
  Real best = std::min(vertices_to_faces(a, b), vertices_to_faces(b, a));
  for (const Edge& e : a.shape.edges) {
    for (const Edge& f : b.shape.edges) {
      best = std::min(best, between_segments(a.vertices[static_cast<std::size_t>(e.from)],
                                             a.vertices[static_cast<std::size_t>(e.to)],
                                             b.vertices[static_cast<std::size_t>(f.from)],
                                             b.vertices[static_cast<std::size_t>(f.to)]));
    }
  }
  return best;
}

}  // namespace

PairTruth true_gap(const ShapePair& pair) {
  const Solid a = solid(pair.a, Vector::Zero(), Matrix::Identity(), pair.pose.scale_a);
  const Solid b = solid(pair.b, pair.pose.centre, pair.pose.turn, pair.pose.scale_b);
  const Separations best = largest_separation(a, b);
  PairTruth truth;
  truth.overlap = best.any <= 0;
  truth.depth = truth.overlap ? -best.any : 0;
  truth.distance = truth.overlap ? 0 : closest_features(a, b);
  truth.separation = best.well_conditioned;
  return truth;
}

}  // namespace grainsweep::testing
