#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

PackingSpec spec_of(double solid_height, std::uint64_t key = 1) {
  PackingSpec spec;
  spec.box = {8, 5, periodic, walls};
  spec.fill = SolidHeight{solid_height};
  spec.random_key = key;
  spec.shape = PinacoidSize{};
  return spec;
}

TEST_CASE("a start has the solid volume asked for") {
  const ConvexShape shape = pinacoid({});
  const auto bed = start<Polyhedron>(spec_of(10));
  REQUIRE(bed);
  double volume = 0;
  for (std::size_t i = 0; i < bed->grains(); ++i)
    volume += shape.volume * std::pow(bed->scale(i), 3);
  // A thousand grains whose volumes scatter by a tenth: the sum by .3 %, three times that here.
  CHECK(volume / 40 == Approx(10).epsilon(0.01));
}

TEST_CASE("grains have the diameters that are drawn for spheres as scales") {
  PackingSpec spec = spec_of(1);
  spec.fill = GrainCount{300};
  spec.sizes.small_share = 0.3;
  const auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  std::vector<double> scales, expected;
  for (std::size_t i = 0; i < bed->grains(); ++i) scales.push_back(bed->scale(i));
  for (const double radius : draw_radii(spec)) expected.push_back(2 * radius);
  std::sort(scales.begin(), scales.end());
  std::sort(expected.begin(), expected.end());
  REQUIRE(scales.size() == expected.size());
  for (std::size_t k = 0; k < scales.size(); ++k) CHECK(scales[k] == Approx(expected[k]));
}

TEST_CASE("centres are inside the column, no two nearer than their balls allow") {
  const ConvexShape shape = pinacoid({});
  const auto bed = start<Polyhedron>(spec_of(6));
  REQUIRE(bed);
  const double ball = start_ball * std::cbrt(shape.volume / sphere_volume(1.0));
  const double height = 6 / polyhedron_start_solid_fraction * 1.02;
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    const Record<double>& c = bed->position[i];
    REQUIRE((c.z > 0 && c.z < height && c.y > 0 && c.y < 5));
    for (std::size_t j = 0; j < i; ++j) {
      const double reach = ball * (bed->scale(i) + bed->scale(j));
      REQUIRE(nearest_difference(*bed, j, i).norm() > reach * (1 - 1e-12));
    }
  }
}

TEST_CASE("orientations are uniform over all rotations") {
  PackingSpec spec = spec_of(1);
  spec.box = {20, 20, periodic, periodic};
  spec.fill = GrainCount{4000};
  const auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  Matrix mean = Matrix::Zero(), square = Matrix::Zero();
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    const Matrix turn = bed->pose(i).orientation.toRotationMatrix();
    REQUIRE(bed->pose(i).orientation.norm() == about(1, 1e-15));
    mean += turn / 4000;
    square += turn.cwiseAbs2() / 4000;
  }
  // Entries are uniform in [-1, 1]: their mean scatters by .009, that of squares by .005.
  CHECK(mean.cwiseAbs().maxCoeff() < 0.04);
  CHECK((square.array() - 1.0 / 3).abs().maxCoeff() < 0.02);
}

TEST_CASE("the same key gives the same bed of shapes, another key another") {
  const ConvexShape shape = pinacoid({});
  const auto a = start<Polyhedron>(spec_of(3)), b = start<Polyhedron>(spec_of(3));
  const auto c = start<Polyhedron>(spec_of(3, 2));
  REQUIRE((a && b && c));
  CHECK(state_hash(*a) == state_hash(*b));
  CHECK(state_hash(*a) != state_hash(*c));
}

TEST_CASE("grains of a mixture start in balls of the volumes of their own components") {
  PackingSpec spec = spec_of(4);
  spec.shape = Mixture{{{0.5, CubeSize{}}, {0.5, CuboidSize{1, 0.3, 0.3}}}, ShareBy::number};
  const auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  const auto ball = [&](std::size_t i) {
    return start_ball * bed->scale(i) * std::cbrt(bed->shape(i).volume / sphere_volume(1.0));
  };
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      REQUIRE(nearest_difference(*bed, i, j).norm() >= ball(i) + ball(j) - 1e-12);  // rounding
    }
  }
}

TEST_CASE("a start in a tube is as high as its floor makes it") {
  PackingSpec spec = spec_of(6);
  spec.box = tube_of(6);
  const auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  double highest = 0.0;
  for (const Record<double>& centre : bed->centres()) highest = std::max(highest, centre.z);
  CHECK(highest > 0.9 * 6 / polyhedron_start_solid_fraction);
}

}  // namespace
}  // namespace grainsweep
