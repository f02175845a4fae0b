#include <numeric>

#include <catch2/catch.hpp>

#include "engine/shape/given_shape.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

/// Cubes and bricks of a quarter of their volume.
Mixture bricks(double share, ShareBy by = ShareBy::volume) {
  return {{{1.0 - share, CubeSize{}}, {share, CuboidSize{1, 1, 0.25}}}, by};
}

TEST_CASE("a share of the volume is a larger one of the grains where these are small") {
  const std::vector<double> shares = number_shares(bricks(0.5));
  CHECK(shares[0] == Approx(0.2));  // 1 cube for 4 bricks
  CHECK(shares[1] == Approx(0.8));
  CHECK(number_shares(bricks(0.25, ShareBy::number))[1] == Approx(0.25));
  CHECK(number_shares(bricks(0.0)) == std::vector<double>{1, 0});
}

TEST_CASE("the numbers of grains are exact to the grain and add up") {
  CHECK(component_counts({0.5, 0.5}, 7) == std::vector<std::int64_t>{4, 3});
  CHECK(component_counts({0.25, 0.35, 0.4}, 10) == std::vector<std::int64_t>{3, 3, 4});
  CHECK(component_counts({1.0, 0.0}, 5) == std::vector<std::int64_t>{5, 0});
  testing::Draw draw(1);
  for (int k = 0; k < 100; ++k) {
    std::vector<double> shares;
    for (int i = 0; i < 5; ++i) shares.push_back(draw.uniform(0, 1));
    const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= whole;
    const auto counts = component_counts(shares, 997);
    REQUIRE(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) == 997);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      REQUIRE(static_cast<double>(counts[i]) == about(997 * shares[i], 1));
    }
  }
}

TEST_CASE("a mixture has the mean volume of its grains, and reaches as far as the largest") {
  const ShapeExtent cube = extent_of(CubeSize{}), brick = extent_of(CuboidSize{1, 1, 0.25});
  const ShapeExtent mixed = extent_of(bricks(0.5));
  CHECK(mixed.volume == Approx(0.2 + 0.8 * 0.25));
  CHECK(mixed.circumradius == cube.circumradius);
  CHECK(mixed.inradius == brick.inradius);
  const ShapeSpec prism = PrismSize{7, 0.6, 1.1};
  const ShapeExtent alike = extent_of(Mixture{{{0.3, prism}, {0.3, prism}, {0.4, prism}}});
  CHECK(alike.volume == extent_of(prism).volume);  // bit by bit
  CHECK(corner_count(Mixture{{{0.5, CubeSize{}}, {0.5, PrismSize{16, 1, 1}}}, ShareBy::number}) ==
        20);
}

TEST_CASE("what is wrong with a mixture is told with the number of the component") {
  CHECK(problem_with(bricks(0.3)).empty());
  CHECK(problem_with(Mixture{}) == "must hold 1 to 16 components, holds 0");
  CHECK(problem_with(Mixture{std::vector<MixtureComponent>(17, {1.0 / 17, CubeSize{}})}) ==
        "must hold 1 to 16 components, holds 17");
  CHECK(problem_with(Mixture{{{0.5, CubeSize{}}, {0.4, CubeSize{}}}}) ==
        "shares must add up to 1, add up to 0.9");
  CHECK(problem_with(Mixture{{{0.333, CubeSize{}}, {0.667, CubeSize{}}}}).empty());
  CHECK(problem_with(bricks(1.5)) == "component 1 (cube) its share must lie in [0, 1], is -0.5");
  CHECK(problem_with(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}}).empty());
  CHECK(problem_with(Mixture{{{1.0, bricks(0.5)}}}) ==
        "component 1 (mixture) must not be a mixture itself");
  CHECK(problem_with(Mixture{{{1.0, CubeSize{-1}}}}).starts_with("component 1 (cube) "));
}

TEST_CASE("a mixture has the shapes of its components, another shape its own") {
  CHECK(shapes_of(CubeSize{}).size() == 1);
  const auto shapes = shapes_of(bricks(0.5));
  REQUIRE(shapes.size() == 2);
  CHECK(shapes[1].volume == Approx(0.25));
}

TEST_CASE("a sphere among polyhedra is as heavy and as hard to turn as a ball of diameter d") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  CHECK((shapes[1].is_ball && !shapes[0].is_ball));
  CHECK(shapes[1].volume == Approx(pi / 6));
  CHECK(shapes[1].inertia == Vector(0.1, 0.1, 0.1));
  CHECK((shapes[1].circumradius == 0.5 && shapes[1].inradius == 0.5));
  CHECK(extent_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}, ShareBy::number}).volume ==
        Approx(0.5 + pi / 12));
}

}  // namespace
}  // namespace grainsweep
