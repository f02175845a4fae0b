#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <catch2/catch.hpp>

#include "engine/broad/candidates.hpp"
#include "engine/measure/touching.hpp"
#include "tests/support/about.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::NamedPair;
using testing::periodic;
using testing::walls;

TEST_CASE("the touching pairs are those a search over all pairs finds, with their gaps") {
  for (const double reach : {1e-5, 1e-3, 0.05}) {
    SphereBed bed = testing::random_bed({{5, 4, periodic, walls}, 200, 0.2, 0.5, 5, 8});
    const Touching touching = find_touching(bed, reach, kernels());
    std::set<NamedPair> found;
    for (const TouchingPair& pair : touching.pairs) {
      REQUIRE(pair.a < pair.b);
      REQUIRE(found.insert({pair.a, pair.b}).second);
      CHECK(pair.gap == about(testing::gap_of(bed, pair.a, pair.b), 1e-13));
    }
    CHECK(found == testing::pairs_closer_than(bed, reach));
    CHECK(found.size() > 100);
  }
}

TEST_CASE("a tolerance by size finds the pairs that a search over all of them finds") {
  const auto tolerance_of = [](double a, double b) { return std::min(0.2 * (a + b), 0.2); };
  for (const double small : {0.5, 0.1, 0.02}) {
    SphereBed bed = testing::random_bed({{5, 4, periodic, walls}, 250, small, 0.7, 5, 8});
    std::set<NamedPair> found, expected;
    for (const TouchingPair& pair : find_touching(bed, tolerance_of, kernels()).pairs) {
      REQUIRE(found.insert({pair.a, pair.b}).second);
    }
    for (const NamedPair& pair : testing::pairs_closer_than(bed, 0.2)) {
      const auto radius = [&](std::int32_t i) {
        return bed.position[static_cast<std::size_t>(i)].w;
      };
      const double gap = testing::gap_of(bed, pair.first, pair.second);
      if (gap < tolerance_of(radius(pair.first), radius(pair.second))) expected.insert(pair);
    }
    CHECK(found == expected);
    CHECK(found.size() > 20);
  }
}

TEST_CASE("the touching walls are those within the tolerance, the floor being wall 0") {
  SphereBed bed =
      make_bed({6, 4, walls, walls},
               {{0.5, 2, 0.5, 0.5}, {3, 0.5 + 2e-4, 0.4, 0.5}, {5.5, 3.5, 2, 0.5}, {3, 2, 2, 0.5}});
  const Touching touching = find_touching(bed, 1e-4, kernels());
  std::set<NamedPair> found;
  for (const TouchingWall& wall : touching.walls) {
    found.insert({wall.grain, wall.wall});
    const Wall plane = bed.walls[static_cast<std::size_t>(wall.wall)];
    CHECK(wall.gap == plane.gap(bed.position[static_cast<std::size_t>(wall.grain)]));
  }
  CHECK(found == std::set<NamedPair>{{0, 0}, {0, 1}, {1, 0}, {2, 2}, {2, 4}});
}

TEST_CASE("grains that have left a periodic box touch as their images do, and are brought back") {
  SphereBed bed = make_bed({6, 4, periodic, walls}, {{-0.3, 2, 0.5, 0.5}, {12.7, 2, 0.5, 0.5}});
  const Touching touching = find_touching(bed, 1e-9, kernels());
  REQUIRE(touching.pairs.size() == 1);
  CHECK(touching.pairs[0].gap == Approx(0).margin(1e-14));
  CHECK(bed.position[0].x == Approx(5.7));
  CHECK(bed.position[1].x == Approx(0.7));
}

TEST_CASE("no grains, or one in the air, touch nothing") {
  SphereBed none = make_bed({6, 4, periodic, walls}, {});
  CHECK(find_touching(none, 0.01, kernels()).pairs.empty());
  SphereBed lone = make_bed({6, 4, periodic, walls}, {{2, 2, 2, 0.5}});
  const Touching touching = find_touching(lone, 0.01, kernels());
  CHECK(touching.pairs.empty());
  CHECK(touching.walls.empty());
}

TEST_CASE("grains with corners touch by the distance of their surfaces") {
  // Faces .001 apart, an edge .02 above a face, a corner on the floor, one cube in another.
  const Quaternion on_edge(Eigen::AngleAxisd(0.78539816339744831, Vector::UnitX()));
  PolyhedronBed bed = testing::shape_bed({9, 9, testing::periodic, testing::walls}, testing::cube(),
                                         {{{1, 1, 0.5}, 1, Quaternion::Identity()},
                                          {{2.001, 1, 0.5}, 1, Quaternion::Identity()},
                                          {{1, 1, 1.02 + std::sqrt(0.5)}, 1, on_edge},
                                          {{5, 5, 5}, 1, Quaternion::Identity()},
                                          {{5.9, 5, 5}, 1, Quaternion::Identity()}});
  const Touching touching = find_touching(bed, 0.05, kernels());
  const auto gap = [&](std::int32_t a, std::int32_t b) {
    for (const TouchingPair& pair : touching.pairs) {
      if (pair.a == a && pair.b == b) return pair.gap;
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  REQUIRE(touching.pairs.size() == 4);
  CHECK(gap(0, 1) == about(0.001, 1e-12));
  CHECK(gap(0, 2) == about(0.02, 1e-12));
  CHECK(gap(1, 2) == about(std::hypot(0.001, 0.02), 1e-12));  // the end of the edge
  CHECK(gap(3, 4) == about(-0.1, 1e-12));
  REQUIRE(touching.walls.size() == 2);
  for (const TouchingWall& wall : touching.walls) CHECK(wall.gap == Approx(0).margin(1e-15));
}

// 1e-14 d: rounding of coordinates in a box of this size.
TEST_CASE("a cube has the same gap from each wall and the floor when its face is as far from it") {
  const double gap = 1e-9, near = 0.5 + gap;
  PolyhedronBed bed = testing::shape_bed({7, 5, walls, walls}, testing::cube(),
                                         {{{3, 2, near}, 1, Quaternion::Identity()},
                                          {{near, 2, 2}, 1, Quaternion::Identity()},
                                          {{7 - near, 2, 2}, 1, Quaternion::Identity()},
                                          {{3, near, 2}, 1, Quaternion::Identity()},
                                          {{3, 5 - near, 2}, 1, Quaternion::Identity()}});
  const Touching touching = find_touching(bed, 0.01, kernels());
  std::set<std::int32_t> grains, found;
  for (const TouchingWall& wall : touching.walls) {
    grains.insert(wall.grain);
    found.insert(wall.wall);
    CHECK(wall.gap == about(gap, 1e-14));
  }
  CHECK(touching.walls.size() == 5);
  CHECK(grains.size() == 5);
  CHECK(found.size() == 5);
}

}  // namespace
}  // namespace grainsweep
