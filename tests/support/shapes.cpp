#include "tests/support/shapes.hpp"

#include <cmath>
#include <stdexcept>

namespace grainsweep::testing {

ConvexShape hull_of(const std::vector<Vector>& points) {
  const Hull hull = convex_hull(points);
  if (!hull.shape) throw std::invalid_argument(hull.error);
  return *hull.shape;
}

HullVertices asked_for(const std::vector<Vector>& points) {
  HullVertices hull;
  for (const Vector& p : points) hull.points.push_back({p.x(), p.y(), p.z()});
  return hull;
}

ConvexShape box_shape(double length, double width, double height) {
  std::vector<Vector> corners;
  for (int k = 0; k < 8; ++k) {
    corners.emplace_back((k & 1 ? 0.5 : -0.5) * length, (k & 2 ? 0.5 : -0.5) * width,
                         (k & 4 ? 0.5 : -0.5) * height);
  }
  return hull_of(corners);
}

ConvexShape cube() { return box_shape(1, 1, 1); }

ConvexShape tetrahedron() { return hull_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}); }

ConvexShape octahedron() {
  return hull_of({{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0}, {0, -0.5, 0}, {0, 0, 0.5}, {0, 0, -0.5}});
}

namespace {

const double golden = (1.0 + std::sqrt(5.0)) / 2.0;

/// (0, +-y, +-z) and what turning the axes makes of it.
void add_turned(double y, double z, std::vector<Vector>& corners) {
  for (const double p : {-y, y}) {
    for (const double q : {-z, z}) {
      corners.insert(corners.end(), {{0, p, q}, {p, q, 0}, {q, 0, p}});
    }
  }
}

}  // namespace

ConvexShape dodecahedron() {
  std::vector<Vector> corners = box_shape(0.6, 0.6, 0.6).vertices;
  add_turned(0.3 / golden, 0.3 * golden, corners);
  return hull_of(corners);
}

ConvexShape icosahedron() {
  std::vector<Vector> corners;
  add_turned(0.3, 0.3 * golden, corners);
  return hull_of(corners);
}

ConvexShape prism(int sides, double height) {
  std::vector<Vector> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / sides;
    for (const double z : {-height / 2.0, height / 2.0}) {
      corners.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), z);
    }
  }
  return hull_of(corners);
}

Vector random_direction(Draw& draw) {
  const Draw::Direction n = draw.direction();
  return {n.x, n.y, n.z};
}

std::vector<Vector> random_corners(Draw& draw, int count) {
  const Vector axes(draw.uniform(0.3, 0.5), draw.uniform(0.3, 0.5), draw.uniform(0.3, 0.5));
  std::vector<Vector> corners;
  for (int k = 0; k < count; ++k) corners.push_back(axes.cwiseProduct(random_direction(draw)));
  return corners;
}

Quaternion random_rotation(Draw& draw) {
  const double u = draw.unit(), v = draw.uniform(0, 6.283185307179586),
               w = draw.uniform(0, 6.283185307179586);
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return Quaternion(p * std::sin(v), p * std::cos(v), q * std::sin(w), q * std::cos(w))
      .normalized();
}

}  // namespace grainsweep::testing
