#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/measure/cut_sphere.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

/// Volume of the part y > a, z > b: discs z = const, whose segments are known, by Simpson's rule in
/// the angle that makes the integrand smooth (z = r sin t).
double integrated_corner(double radius, double a, double b) {
  const double first = std::asin(std::clamp(b / radius, -1.0, 1.0)), last = pi / 2;
  const auto segment = [&](double t) {
    const double disc = radius * std::cos(t), cut = std::clamp(a, -disc, disc);
    const double area = disc * disc * std::acos(disc > 0 ? cut / disc : 1.0) -
                        cut * std::sqrt(std::max(0.0, disc * disc - cut * cut));
    return area * radius * std::cos(t);
  };
  const int halves = 20000;
  const double h = (last - first) / (2 * halves);
  double sum = segment(first) + segment(last);
  for (int k = 1; k < 2 * halves; ++k) sum += (k % 2 == 1 ? 4 : 2) * segment(first + k * h);
  return sum * h / 3;
}

TEST_CASE("two planes through the centre cut off a quarter") {
  for (const double radius : {0.1, 0.5, 3.0}) {
    CHECK(sphere_corner_volume(radius, 0, 0) == Approx(sphere_volume(radius) / 4).epsilon(1e-15));
  }
}

TEST_CASE("a plane that leaves the whole ball on one side leaves the cap of the other plane") {
  const double r = 0.7;
  for (const double b : {-0.8, -0.7, -0.3, 0.0, 0.2, 0.69, 0.7, 5.0}) {
    const double cap = sphere_slab_volume(r, b, 9);
    CHECK(sphere_corner_volume(r, -r, b) == about(cap, 1e-15));
    CHECK(sphere_corner_volume(r, -4, b) == about(cap, 1e-15));
    CHECK(sphere_corner_volume(r, b, -r) == about(cap, 1e-15));
    CHECK(sphere_corner_volume(r, b, r) == 0);
    CHECK(sphere_corner_volume(r, 7, b) == 0);
  }
}

TEST_CASE("the four corners of any two planes have the ball's volume together") {
  const double r = 0.5, volume = sphere_volume(r);
  for (double a = -0.55; a < 0.6; a += 0.05) {
    for (double b = -0.55; b < 0.6; b += 0.05) {
      const double both = sphere_corner_volume(r, a, b) + sphere_corner_volume(r, -a, -b);
      const double crossed = sphere_corner_volume(r, a, -b) + sphere_corner_volume(r, -a, b);
      REQUIRE(both + crossed == Approx(volume).epsilon(1e-14));
      REQUIRE(sphere_corner_volume(r, a, b) == about(sphere_corner_volume(r, b, a), 1e-15));
    }
  }
}

// Simpson's rule in 40,000 steps; the kink where a segment ends leaves an error of h^2.5 or so.
TEST_CASE("the closed form is what integration gives") {
  const double r = 0.5;
  for (const double a : {-0.45, -0.2, 0.0, 0.1, 0.33, 0.49}) {
    for (const double b : {-0.4, -0.1, 0.05, 0.3, 0.48}) {
      INFO(a << " " << b);
      CHECK(sphere_corner_volume(r, a, b) == about(integrated_corner(r, a, b), 2e-10));
    }
  }
}

TEST_CASE("a beam from below is a slab once its top lies above the ball") {
  for (const double low : {-0.9, -0.5, -0.1, 0.3}) {
    CHECK(sphere_beam_volume(0.5, 0.5, low, 0.4) ==
          about(sphere_slab_volume(0.5, low, 0.4), 1e-15));
    CHECK(sphere_beam_volume(0.5, -0.5, low, 0.4) == Approx(0).margin(1e-15));
    CHECK(sphere_beam_volume(0.5, 0, low, 0.4) ==
          about(sphere_slab_volume(0.5, low, 0.4) / 2, 1e-15));
  }
}

/// Volume of the part x > a, y > b, z > c by the midpoint rule over the plane z = 0.
double summed_octant(double radius, double a, double b, double c) {
  const int cells = 1000;
  const double h = 2 * radius / cells;
  double sum = 0.0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const double x = -radius + (i + 0.5) * h, y = -radius + (j + 0.5) * h;
      const double high = std::sqrt(std::max(0.0, radius * radius - x * x - y * y));
      if (x > a && y > b) sum += std::max(0.0, high - std::max(c, -high));
    }
  }
  return sum * h * h;
}

// Planes stand on borders of the cells, so that what the midpoint rule misses is of the order of
// h^1.5 at the rim: 2e-5 of a ball of radius 0.5.
TEST_CASE("three planes leave of a ball what summing gives, wherever they stand") {
  const double r = 0.5;
  for (const double a : {-0.6, -0.3, 0.0, 0.2}) {
    for (const double b : {-0.45, 0.1, 0.35}) {
      for (const double c : {-0.2, 0.0, 0.3, 0.6}) {
        INFO(a << " " << b << " " << c);
        CHECK(sphere_octant_volume(r, a, b, c) == about(summed_octant(r, a, b, c), 2e-5));
      }
    }
  }
  CHECK(sphere_octant_volume(r, 0, 0, 0) == Approx(sphere_volume(r) / 8).epsilon(1e-15));
}

TEST_CASE("the eight parts beyond any three planes have the ball's volume together") {
  const double r = 0.5;
  for (double a = -0.55; a < 0.6; a += 0.1) {
    for (double b = -0.5; b < 0.6; b += 0.1) {
      for (double c = -0.5; c < 0.6; c += 0.13) {
        double sum = 0.0;
        for (const double x : {a, -a}) {
          for (const double y : {b, -b}) {
            for (const double z : {c, -c}) sum += sphere_octant_volume(r, x, y, z);
          }
        }
        REQUIRE(sum == Approx(sphere_volume(r)).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("a box that two planes at right angles bound holds a beam") {
  constexpr double far = std::numeric_limits<double>::infinity();
  for (const double top : {-0.3, 0.0, 0.2, 0.7}) {
    CHECK(sphere_box_volume(0.5, {-far, far}, {-far, top}, {-0.2, 0.4}) ==
          about(sphere_beam_volume(0.5, top, -0.2, 0.4), 1e-15));
  }
  CHECK(sphere_box_volume(0.5, {-1, 1}, {-far, far}, {-0.5, 2}) ==
        Approx(sphere_volume(0.5)).epsilon(1e-15));
  CHECK(sphere_box_volume(0.5, {-0.1, 0.1}, {-0.1, 0.1}, {-0.1, 0.1}) ==
        Approx(0.008).epsilon(1e-13));
}

}  // namespace
}  // namespace grainsweep
