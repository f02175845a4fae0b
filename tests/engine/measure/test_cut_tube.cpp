#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/measure/cut_tube.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

using Long = long double;
constexpr Long long_pi = std::numbers::pi_v<long double>;

/// Area that two discs share, by the law of cosines.
Long lens(Long a, Long b, Long distance) {
  if (a > b) std::swap(a, b);
  if (distance >= a + b) return 0;
  if (distance <= b - a) return long_pi * a * a;
  const auto angle = [&](Long r, Long other) {
    const Long cosine = (distance * distance + r * r - other * other) / (2 * distance * r);
    return std::acos(std::clamp(cosine, Long(-1), Long(1)));
  };
  const auto segment = [](Long r, Long half) { return r * r * (half - std::sin(2 * half) / 2); };
  return segment(a, angle(a, b)) + segment(b, angle(b, a));
}

/// The integral of f, smooth inside, whatever it does at the ends (tanh-sinh rule).
template <class F>
Long integral(Long low, Long high, const F& f) {
  constexpr int steps = 150;
  constexpr Long step = 4.0L / steps;
  const Long middle = (low + high) / 2, half = (high - low) / 2;
  Long sum = 0;
  for (int k = -steps; k <= steps; ++k) {
    const Long t = step * k, s = long_pi / 2 * std::sinh(t), c = std::cosh(s);
    sum += f(middle + half * std::tanh(s)) * long_pi / 2 * std::cosh(t) / (c * c);
  }
  return sum * step * half;
}

/// The same volume by quadrature in long double, between the heights where the form changes.
double brute_force(double radius, double distance, double tube, double low, double high) {
  const Long r = radius;
  std::vector<Long> cuts = {std::max<Long>(-r, low), std::min<Long>(r, high)};
  if (cuts[0] >= cuts[1]) return 0;
  const Long bottom = cuts[0], top = cuts[1];
  for (const Long disc : {std::abs(Long(tube) - distance), Long(tube) + distance}) {
    if (disc >= r) continue;
    const Long z = std::sqrt(r * r - disc * disc);
    for (const Long cut : {z, -z}) {
      if (cut > bottom && cut < top) cuts.push_back(cut);
    }
  }
  if (bottom < 0 && top > 0) cuts.push_back(0);  // beside it where discs nearly hold each other
  std::sort(cuts.begin(), cuts.end());
  Long volume = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    volume += integral(cuts[k], cuts[k + 1], [&](Long z) {
      return lens(std::sqrt(std::max(Long(0), r * r - z * z)), tube, distance);
    });
  }
  return static_cast<double>(volume);
}

TEST_CASE("a tube cuts from a sphere what a quadrature of the discs finds") {
  Draw draw(41);
  for (int k = 0; k < 400; ++k) {
    const double radius = draw.uniform(0.05, 0.7);
    const double tube = k % 3 == 0   ? draw.uniform(0.01, 1.5 * radius)
                        : k % 3 == 1 ? draw.uniform(1, 10)
                                     : draw.uniform(10, 1000);
    double distance = std::max(0.0, tube + draw.uniform(-1.1, 1.1) * radius);
    if (k % 7 == 0) distance = tube + 1e-6 * draw.unit();      // the centre in the wall
    if (k % 11 == 0) distance = std::max(0.0, tube - radius);  // it touches from within
    if (k % 13 == 0) distance = 0;
    const double low = k % 2 == 0 ? -1 : draw.uniform(-radius, radius);
    const double high = k % 5 == 0 ? low + draw.uniform(0, radius) : 1;
    INFO("radius " << radius << ", distance " << distance << ", tube " << tube);
    CHECK(sphere_tube_volume(radius, distance, tube, low, high) ==
          about(brute_force(radius, distance, tube, low, high), 1e-13 * sphere_volume(radius)));
  }
}

TEST_CASE("a tube cuts from a part of a sphere what a quadrature finds, however near its wall is") {
  Draw draw(45);
  for (int k = 0; k < 2000; ++k) {
    const double radius = draw.uniform(0.3, 0.7), tube = draw.uniform(0.5, 3);
    const double from_wall = draw.uniform(0.05, 0.35) * radius;
    const double distance = std::max(0.0, k % 2 == 0 ? tube + from_wall : tube - from_wall);
    const double high = draw.uniform(-1, 1) * radius;
    INFO("radius " << radius << ", distance " << distance << ", tube " << tube);
    CHECK(sphere_tube_volume(radius, distance, tube, -radius, high) ==
          about(brute_force(radius, distance, tube, -radius, high), 1e-13 * sphere_volume(radius)));
  }
  const double r = 0.6671928316356102, distance = 1.9336218917505703, tube = 2.0004226765782835;
  CHECK(sphere_tube_volume(r, distance, tube, 0, 0.66379) ==
        about(brute_force(r, distance, tube, 0, 0.66379), 1e-13 * sphere_volume(r)));
}

TEST_CASE("what a tube cuts from a sphere in its whole height is known to the last digits") {
  Draw draw(44);
  for (int k = 0; k < 300; ++k) {
    const double radius = draw.uniform(0.05, 0.7);
    double tube = k % 2 == 0 ? draw.uniform(0.01, 2 * radius) : draw.uniform(1, 1000);
    double distance = std::max(0.0, tube + draw.uniform(-1, 1) * radius);
    const double nearly = std::pow(10, -draw.uniform(1, 15)) * draw.uniform(-1, 1);
    if (k % 5 == 0) distance = tube;                                    // the centre in the wall
    if (k % 5 == 1) distance = tube + nearly;                           // or nearly
    if (k % 7 == 0) tube = std::max(0.01, radius - distance) + nearly;  // it touches from within
    if (k % 11 == 0) distance = std::max(0.0, nearly);
    INFO("radius " << radius << ", distance " << distance << ", tube " << tube);
    const double exact = brute_force(radius, distance, tube, -radius, radius);
    CHECK(sphere_tube_volume(radius, distance, tube, -radius, radius) ==
          about(exact, 5e-15 * sphere_volume(radius)));
  }
}

TEST_CASE("a tube cuts what is known: all, nothing, a cylinder's core, half at a wide wall") {
  const double whole = sphere_volume(0.5);
  CHECK(sphere_tube_volume(0.5, 1.5, 2.0, -1, 1) == Approx(whole).epsilon(1e-15));
  CHECK(sphere_tube_volume(0.5, 2.5, 2.0, -1, 1) == 0);
  CHECK(sphere_tube_volume(0.5, 0.2, 0.0, -1, 1) == 0);
  CHECK(sphere_tube_volume(0.5, 1.0, 2.0, 0.3, 0.3) == 0);
  // A drill of radius a through the centre leaves 4/3 pi (r^2 - a^2)^(3/2).
  CHECK(whole - sphere_tube_volume(0.5, 0.0, 0.3, -1, 1) ==
        Approx(4.0 / 3.0 * pi * std::pow(0.25 - 0.09, 1.5)).epsilon(1e-14));
  CHECK(sphere_tube_volume(0.5, 1e6, 1e6, -1, 1) == Approx(whole / 2).epsilon(1e-6));
  CHECK(sphere_tube_volume(0.5, 1.0, 2.0, -0.2, 0.4) ==
        Approx(sphere_slab_volume(0.5, -0.2, 0.4)).epsilon(1e-14));
}

TEST_CASE("the area that two discs share does not depend on which comes first") {
  Draw draw(42);
  for (int k = 0; k < 200; ++k) {
    const double a = draw.uniform(0.01, 2), b = draw.uniform(0.01, 2), d = draw.uniform(0, 4);
    CHECK(shared_area(a, b, d) == shared_area(b, a, d));
    // Digits that cancel where the discs nearly hold each other: 1e-12 of the smaller one.
    const double smaller = pi * std::min(a, b) * std::min(a, b);
    CHECK(shared_area(a, b, d) == about(static_cast<double>(lens(a, b, d)), 1e-12 * smaller));
  }
}

/// Cut into thin upright slices, each as wide as the tube is there.
double sliced_volume(const ConvexShape& shape, const Pose& pose, double axis, double tube,
                     double low, double high) {
  constexpr int slices = 4000;
  const Span span = span_along(shape, pose, 0);
  const double from = std::max(span.low, axis - tube), to = std::min(span.high, axis + tube);
  const double width = (to - from) / slices;
  double volume = 0;
  for (int k = 0; k < slices && width > 0; ++k) {
    const double x = from + (k + 0.5) * width - axis;
    const double half = std::sqrt(std::max(0.0, tube * tube - x * x));
    volume += box_volume(shape, pose, {from + k * width, axis - half, low},
                         {from + (k + 1) * width, axis + half, high});
  }
  return volume;
}

TEST_CASE("a tube cuts from a polyhedron what thin slices of it add up to") {
  Draw draw(43);
  const ConvexShape pinacoid = *shape_of(ShapeSpec{PinacoidSize{}}).shape;
  for (int k = 0; k < testing::tries(60); ++k) {
    Quaternion turn(draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1),
                    draw.uniform(-1, 1));
    turn.normalize();
    if (k % 5 == 0) turn = Quaternion::Identity();
    const double tube = k % 3 == 0 ? draw.uniform(0.2, 1) : draw.uniform(1, 8);
    const double angle = draw.uniform(0, 7), from_axis = std::max(0.0, tube + draw.uniform(-1, 1));
    const Pose pose{{8 + from_axis * std::cos(angle), 8 + from_axis * std::sin(angle), 3},
                    draw.uniform(0.5, 1.2),
                    turn};
    const double low = k % 2 == 0 ? 0 : draw.uniform(2.5, 3), high = k % 4 == 0 ? 9 : 3.2;
    INFO("tube " << tube << ", from the axis " << from_axis);
    // Slices err by the square of their width over the tube's curvature.
    CHECK(polyhedron_tube_volume(pinacoid, pose, 8, tube, low, high) ==
          about(sliced_volume(pinacoid, pose, 8, tube, low, high), 3e-6 * pinacoid.volume));
  }
}

// The volume by a midpoint rule of 4000 heights, good to 1e-9.
TEST_CASE("a tube cuts a turned cube where kinks of its sections hide between a rule's heights") {
  const Quaternion turn(-0.48861020013473994, -0.1697201361989293, -0.11103048396091748,
                        0.848603193091041);
  const Pose pose{{2.04357262979903925, 2, 1}, 1.0, turn.normalized()};
  CHECK(polyhedron_tube_volume(testing::cube(), pose, 2, 0.43691919976484883, -1, 3) ==
        about(0.6184401880, 1e-7));
}

TEST_CASE("a tube cuts from an upright cube what is known") {
  const ConvexShape cube = testing::cube();
  const Pose pose{{2, 2, 1}, 1.0, Quaternion::Identity()};
  const auto cut = [&](double tube) { return polyhedron_tube_volume(cube, pose, 2, tube, 0, 3); };
  CHECK(cut(0.4) == about(0.16 * pi, 1e-7));
  CHECK(cut(0.8) == about(1.0, 1e-12));
  // Beyond the sides four segments of the disc stick out.
  const double r = 0.6, half = std::acos(0.5 / r);
  const double segment = r * r * (half - std::sin(half) * std::cos(half));
  CHECK(cut(r) == about(pi * r * r - 4 * segment, 1e-7));
  CHECK(polyhedron_tube_volume(cube, pose, 2, r, 1, 1.25) ==
        about(0.25 * (pi * r * r - 4 * segment), 1e-7));
}

}  // namespace
}  // namespace grainsweep
