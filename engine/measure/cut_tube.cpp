#include "engine/measure/cut_tube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// x - sin x without the loss of digits near 0.
double minus_sine(double x) {
  if (x > 0.5) return x - std::sin(x);
  const double squared = x * x;
  double term = x * squared / 6.0, sum = term;
  for (double k = 4.0; k < 20.0; k += 2.0) {
    term *= -squared / (k * (k + 1.0));
    sum += term;
  }
  return sum;
}

/// Area of the segment of a disc whose chord is seen under the angle 2 `half_angle`.
double segment_area(double radius, double half_angle) {
  return 0.5 * radius * radius * minus_sine(2.0 * half_angle);
}

/// Integral of the area that the discs of a ball and of a cylinder share, between two heights
/// between which neither disc holds the other. Where their rims nearly touch all the way round,
/// Gauss's rule alone would lose half the digits.
double crossing_volume(double radius, double distance, double tube, double low, double high) {
  if (high <= low) return 0.0;
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  const auto shared = [&](double t) {
    const double z = middle - half * std::cos(t);
    const double disc = std::sqrt(std::max(0.0, (radius - z) * (radius + z)));
    return shared_area(disc, tube, distance) * half * std::sin(t);
  };
  using boost::math::quadrature::gauss, boost::math::quadrature::gauss_kronrod;
  constexpr unsigned most_halvings = 8;
  return std::abs(tube - distance) > 0.2 * radius
             ? gauss<double, 30>::integrate(shared, 0.0, pi)
             : gauss_kronrod<double, 31>::integrate(shared, 0.0, pi, most_halvings, 1e-13);
}

// ---- whole spheres ----

using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

/// Integral of s^2 c^2 / sqrt(1 - k^2 s^2), s = sin t and c = cos t, from 0 to pi/2, for a small
/// k^2, where the combination of complete integrals that it equals would lose digits. The integrand
/// is periodic, so that the midpoint rule converges like (k^2 / 16)^2n.
double midpoint_integral(double k_squared) {
  constexpr std::size_t points = 6;
  static const std::array<double, points> sine_squared = [] {
    std::array<double, points> squares{};
    for (std::size_t j = 0; j < points; ++j) {
      const double sine = std::sin((static_cast<double>(j) + 0.5) * pi / (2.0 * points));
      squares[j] = sine * sine;
    }
    return squares;
  }();
  double sum = 0.0;
  for (const double s : sine_squared) sum += s * (1.0 - s) / std::sqrt(1.0 - k_squared * s);
  return sum * pi / (2.0 * points);
}

/// Volume shared by a ball and an endless cylinder.
///
/// By parts it is 4 pi/3 a^3, if the cylinder's axis meets the ball's middle height within its rim,
/// less 4/3 of the integral of (a^2 - u)^(3/2) over the half angle of the arc that lies in the
/// cylinder, of the circle with radius sqrt(u) about the ball's centre. In u it is elliptic:
///
///   1/2 (a^2 - u)^2 (u + R^2 - b^2) / (u sqrt((a^2 - u) ((b + R)^2 - u) (u - (b - R)^2))) du
///
/// from the third root to the nearest other one (a: radius, R: tube, b: distance). With
/// u = C + (B - C) sin^2 t it becomes four complete integrals, in Carlson's forms, of 1, u, u^2 and
/// 1/u over sqrt(1 - k^2 sin^2 t).
double whole_volume(double radius, double distance, double tube) {
  using boost::math::ellint_rd, boost::math::ellint_rf, boost::math::ellint_rj;
  constexpr double least = 1e-100;       // k = 1: what grows like its logarithm has no weight
  constexpr double small_modulus = 0.1;  // above it one digit is lost
  const double ball = 4.0 / 3.0 * pi * radius * radius * radius;
  const double squared = radius * radius, far = (tube + distance) * (tube + distance);
  const double near = (tube - distance) * (tube - distance);
  const double inside = tube > distance ? ball : tube < distance ? 0.0 : ball / 2.0;
  if (near >= squared) return inside;
  const double end = std::min(squared, far), width = end - near;
  const double wide = std::max(squared, far) - near, k_squared = width / wide;
  const double rest = std::max(std::abs(squared - far) / wide, least);  // 1 - k^2
  const double zeroth = ellint_rf(0.0, rest, 1.0, InDouble());
  const double first = ellint_rd(0.0, rest, 1.0, InDouble()) / 3.0;  // of sin^2 t, next of sin^4 t
  const double second = k_squared < small_modulus
                            ? first - midpoint_integral(k_squared)
                            : (2.0 * (1.0 + k_squared) * first - zeroth) / (3.0 * k_squared);
  const auto inverse = [&] {
    const double third = ellint_rj(0.0, rest, 1.0, rest * near / end, InDouble());
    return (zeroth + width * rest / (3.0 * end) * third) / end;
  };
  const double u = near * zeroth + width * first;
  const double uu = near * near * zeroth + width * (2.0 * near * first + width * second);
  const double beyond = (tube - distance) * (tube + distance);
  const double of_inverse = near > 0.0 ? squared * squared * beyond * inverse() : 0.0;
  const double sum =
      uu + (beyond - 2.0 * squared) * u + squared * (squared - 2.0 * beyond) * zeroth + of_inverse;
  return inside - 4.0 / 3.0 * sum / std::sqrt(wide);
}

/// The part of it between the middle of the ball and a height above it.
double volume_up_to(double height, double radius, double distance, double tube) {
  // The height at which the ball's disc has the radius `disc`; 0 if none is so large.
  const auto height_of = [&](double disc) {
    return disc < radius ? std::sqrt((radius - disc) * (radius + disc)) : 0.0;
  };
  const double holds = std::min(height, height_of(tube + distance));  // discs hold the tube's,
  const double crosses = std::min(height, height_of(std::abs(tube - distance)));  // or cross it
  const double below =
      pi * tube * tube * holds + crossing_volume(radius, distance, tube, holds, crosses);
  return distance >= tube ? below : below + sphere_slab_volume(radius, crosses, height);
}

// ---- polyhedra ----

/// Error allowed of an integral between two heights, in volumes of the grain.
constexpr double allowed_error = 1e-10;

/// Integral of an area over the height. Where the rim of the disc passes a corner or a side of the
/// section the area has a kink: pieces are halved until their halves add up to the whole.
template <class Area>
double integral(const Area& area, double low, double high, double error, int halvings = 10) {
  using boost::math::quadrature::gauss;
  const double middle = 0.5 * (low + high);
  const double whole = gauss<double, 7>::integrate(area, low, high);
  const double halves = gauss<double, 7>::integrate(area, low, middle) +
                        gauss<double, 7>::integrate(area, middle, high);
  if (halvings == 0 || std::abs(whole - halves) <= error) return halves;
  return integral(area, low, middle, error / 2.0, halvings - 1) +
         integral(area, middle, high, error / 2.0, halvings - 1);
}

/// A point of a horizontal section, from the axis of the cylinder, d.
struct Point {
  double x, y;
};
double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }

/// Area shared by a disc about the origin and the triangle of the origin, p and q; negative if the
/// way from p to q is clockwise.
double triangle_area(const Point& p, const Point& q, double radius) {
  const auto sector = [&](const Point& a, const Point& b) {
    return 0.5 * radius * radius * std::atan2(cross(a, b), dot(a, b));
  };
  const Point way{q.x - p.x, q.y - p.y};
  const double length = dot(way, way), along = dot(p, way);
  const double beyond = dot(p, p) - radius * radius;
  const double squared = along * along - length * beyond;
  if (!(squared > 0.0) || !(length > 0.0)) return sector(p, q);
  const double root = std::sqrt(squared);
  const double in = (-along - root) / length, out = (-along + root) / length;
  if (in >= 1.0 || out <= 0.0) return sector(p, q);
  const auto at = [&](double share) { return Point{p.x + share * way.x, p.y + share * way.y}; };
  const Point first = in > 0.0 ? at(in) : p, last = out < 1.0 ? at(out) : q;
  return (in > 0.0 ? sector(p, first) : 0.0) + 0.5 * cross(first, last) +
         (out < 1.0 ? sector(last, q) : 0.0);
}

/// A grain's vertices, from the axis of the cylinder and in the box's frame.
using Vertices = std::vector<Vector>;

/// A corner of a section, and a number that grows with its angle about the section's middle.
struct Ranked {
  Point at;
  double rank;
};

/// Grows with the angle of a vector from -pi to pi, from -2 to 2; 0 of none.
double rank_of(const Point& v) {
  const double size = std::abs(v.x) + std::abs(v.y);
  if (size == 0.0) return 0.0;
  const double along = v.x / size;
  return v.y < 0.0 ? along - 1.0 : 1.0 - along;
}

/// The convex polygon in which a horizontal plane cuts a grain, counter-clockwise.
void cut_section(const ConvexShape& shape, const Vertices& corners, double z,
                 std::vector<Ranked>& polygon) {
  polygon.clear();
  Point middle{0.0, 0.0};
  for (const Edge& edge : shape.edges) {
    const Vector &a = corners[static_cast<std::size_t>(edge.from)],
                 &b = corners[static_cast<std::size_t>(edge.to)];
    if ((a.z() < z) == (b.z() < z)) continue;
    const double share = (z - a.z()) / (b.z() - a.z());
    const Point at{a.x() + share * (b.x() - a.x()), a.y() + share * (b.y() - a.y())};
    polygon.push_back({at, 0.0});
    middle = {middle.x + at.x, middle.y + at.y};
  }
  const auto count = static_cast<double>(polygon.size());
  for (Ranked& corner : polygon) {
    corner.rank = rank_of({corner.at.x - middle.x / count, corner.at.y - middle.y / count});
  }
  std::sort(polygon.begin(), polygon.end(),
            [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
}

/// Area that a section shares with the disc.
double area_in(const std::vector<Ranked>& section, double tube) {
  double area = 0.0;
  for (std::size_t k = 0; k < section.size(); ++k) {
    area += triangle_area(section[k].at, section[(k + 1) % section.size()].at, tube);
  }
  return area;
}

/// Heights of the vertices between two others, and these, in order: between them sections have the
/// same corners.
std::vector<double> form_heights(const Vertices& corners, double low, double high) {
  std::vector<double> heights = {low, high};
  for (const Vector& corner : corners) {
    if (corner.z() > low && corner.z() < high) heights.push_back(corner.z());
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

}  // namespace

double polyhedron_tube_volume(const ConvexShape& shape, const Pose& pose, double axis, double tube,
                              double low, double high) {
  const double from_axis = std::hypot(pose.centre.x() - axis, pose.centre.y() - axis);
  const double reach = pose.scale * shape.circumradius;
  if (tube <= 0.0 || from_axis - reach >= tube) return 0.0;
  if (shape.is_ball) {
    return sphere_tube_volume(reach, from_axis, tube, low - pose.centre.z(),
                              high - pose.centre.z());
  }
  if (from_axis + reach <= tube) return slab_volume(shape, pose, 2, low, high);
  Vertices corners;
  Span upright{pose.centre.z(), pose.centre.z()};
  for (const Vector& vertex : shape.vertices) {
    const Vector corner = pose.place(vertex);
    corners.push_back(corner - Vector(axis, axis, 0.0));
    upright = {std::min(upright.low, corner.z()), std::max(upright.high, corner.z())};
  }
  const double bottom = std::max(low, upright.low), top = std::min(high, upright.high);
  if (bottom >= top) return 0.0;
  const std::vector<double> heights = form_heights(corners, bottom, top);
  std::vector<Ranked> polygon;
  const auto area = [&](double z) {
    cut_section(shape, corners, z, polygon);
    return area_in(polygon, tube);
  };
  const double error = allowed_error * pose.scale * pose.scale * pose.scale * shape.volume;
  double volume = 0.0;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    volume += integral(area, heights[k], heights[k + 1], error);
  }
  return volume;
}

double shared_area(double radius, double other_radius, double distance) {
  const double a = std::min(radius, other_radius), b = std::max(radius, other_radius);
  if (distance >= a + b) return 0.0;
  if (distance <= b - a) return pi * a * a;
  // Sixteen times the squared area of the triangle between the centres and a crossing of the rims.
  const double squared =
      (a + b + distance) * (a + b - distance) * (distance + (b - a)) * (distance - (b - a));
  const double chord = std::sqrt(std::max(0.0, squared));
  const double gap = distance - b;  // keeps its digits beside a large disc
  const double at_a = std::atan2(chord, gap * (distance + b) + a * a);
  const double at_b = std::atan2(chord, (b - a) * (b + a) + distance * distance);
  return segment_area(a, at_a) + segment_area(b, at_b);
}

double sphere_tube_volume(double radius, double distance, double tube, double low, double high) {
  if (low >= std::min(high, radius) || high <= -radius || tube <= 0.0) return 0.0;
  if (distance - tube >= radius) return 0.0;
  tube = std::min(tube, distance + radius);  // a wider one holds as much
  const auto up_to = [&](double height) {
    const double half = std::abs(height) >= radius
                            ? 0.5 * whole_volume(radius, distance, tube)
                            : volume_up_to(std::abs(height), radius, distance, tube);
    return std::copysign(half, height);
  };
  const double bottom = std::max(low, -radius), top = std::min(high, radius);
  return top == radius && bottom == -radius ? whole_volume(radius, distance, tube)
                                            : up_to(top) - up_to(bottom);
}

}  // namespace grainsweep
