#include <algorithm>

#include <catch2/catch.hpp>

#include "engine/scene/components.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

Mixture bricks(double share) {
  return {{{1.0 - share, CubeSize{}}, {share, CuboidSize{1, 1, 0.25}}}};
}

TEST_CASE("components are drawn in exact numbers, in an order of their own") {
  const auto drawn = draw_components(bricks(0.5), 100, 1);
  REQUIRE(drawn.size() == 100);
  CHECK(std::count(drawn.begin(), drawn.end(), 0) == 20);
  CHECK(std::count(drawn.begin(), drawn.end(), 1) == 80);
  CHECK_FALSE(std::is_sorted(drawn.begin(), drawn.end()));
  CHECK(draw_components(bricks(0.5), 100, 1) == drawn);
  CHECK(draw_components(bricks(0.5), 100, 2) != drawn);
  CHECK(draw_components(CubeSize{}, 100, 1).empty());
}

TEST_CASE("components are as likely anywhere among the grains") {
  // Of 10,000 grains a fifth are cubes: in each tenth 200, which scatter by 12.
  const auto drawn = draw_components(bricks(0.5), 10000, 3);
  for (auto tenth = drawn.begin(); tenth != drawn.end(); tenth += 1000) {
    CHECK(std::count(tenth, tenth + 1000, 0) == about(200, 50));
  }
}

PackingSpec spec_of(const ShapeSpec& shape) {
  PackingSpec spec;
  spec.shape = shape;
  spec.box = {8, 5, Boundary::periodic, Boundary::walls};
  spec.fill = SolidHeight{8};
  spec.random_key = 4;
  return spec;
}

TEST_CASE("a mixture starts with the solid volume and the shares that are asked for") {
  const auto bed = start<Polyhedron>(spec_of(bricks(0.3)));
  REQUIRE(bed);
  std::vector<double> volume(2), masses(2);
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    const double cube = sphere_mass(bed->position[i].w);
    volume[bed->component(i)] += cube * bed->shape(i).volume;
    masses[bed->component(i)] += 1.0 / bed->motion[i].w;
    REQUIRE(bed->shape(i).vertices.size() == 8);
  }
  // Five hundred grains whose volumes scatter by a tenth: sums by 1 %, three times that here.
  CHECK(volume[0] + volume[1] == Approx(8 * 40).epsilon(0.02));
  CHECK(volume[1] / (volume[0] + volume[1]) == Approx(0.3).epsilon(0.03));
  CHECK(masses[0] == Approx(volume[0]));  // in those of a cube of size 1
  CHECK(masses[1] == Approx(volume[1]));
}

TEST_CASE("grains of a mixture have the sizes that are drawn, whatever their component") {
  PackingSpec spec = spec_of(bricks(0.5));
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

TEST_CASE("a mixture of equal components starts as their shape alone does, bit by bit") {
  for (const ShapeSpec& shape : {ShapeSpec(PinacoidSize{1.5, 1, 0.7}), ShapeSpec(PrismSize{})}) {
    const auto alone = start<Polyhedron>(spec_of(shape));
    const auto one = start<Polyhedron>(spec_of(Mixture{{{1.0, shape}}}));
    const auto two = start<Polyhedron>(spec_of(Mixture{{{0.4, shape}, {0.6, shape}}}));
    REQUIRE((alone && one && two));
    CHECK(state_hash(*one) == state_hash(*alone));
    CHECK(state_hash(*two) == state_hash(*alone));
    CHECK(two->components.size() == alone->grains());
  }
}

}  // namespace
}  // namespace grainsweep
