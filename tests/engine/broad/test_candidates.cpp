#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/broad/candidates.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::NamedPair;
using testing::periodic;
using testing::RandomScene;
using testing::walls;

constexpr double listed_reach = 0.13;

Candidates search(SphereBed& bed, double within = listed_reach) {
  Candidates candidates;
  wrap(bed);
  find_candidates({bed, bed.position}, within, kernels_for(best_isa()), candidates);
  return candidates;
}

/// The list holds every pair within reach once, and none that is farther than the reach by more
/// than the search's rounding of positions, 1e-6 of the bed's extent, explains.
void expect_right_list(SphereBed& bed, double within = listed_reach) {
  const Candidates candidates = search(bed, within);
  CHECK(testing::holds_all_closer_than(bed, candidates, within));
  double extent = 2.0 * std::max(bed.box.length, bed.box.width);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    extent = std::max(extent, std::abs(bed.position[i].z));
  }
  for (const NamedPair& pair : testing::listed_pairs(candidates)) {
    REQUIRE(testing::gap_of(bed, pair.first, pair.second) < within + 2e-6 * extent);
  }
  for (std::size_t k = 0; k < bed.walls.size(); ++k) {
    const WallCandidates& near = candidates.walls[k];
    REQUIRE(std::is_sorted(near.grains.begin(), near.grains.end()));
    for (const std::int32_t grain : near.grains) {
      REQUIRE(bed.walls[k].gap(bed.position[static_cast<std::size_t>(grain)]) < within);
    }
  }
}

const Box boxes[] = {{8, 5, periodic, walls},        {8, 5, periodic, periodic},
                     {8, 5, walls, walls},           {5, 8, walls, periodic},
                     {2.3, 2.3, periodic, periodic}, {2.3, 1.0, periodic, walls},
                     {1.0, 1.0, walls, walls},       {20, 2.5, periodic, periodic}};

TEST_CASE("the list is what a search over all pairs finds, in every kind of box") {
  for (const Box& box : boxes) {
    for (const std::size_t grains : {0U, 1U, 2U, 3U, 10U, 150U, 500U}) {
      for (const double height : {0.0, 1.0, 6.0, 40.0}) {
        INFO(box.length << " x " << box.width << ", " << grains << " grains in height " << height);
        SphereBed bed = testing::random_bed({box, grains, 0.4, 0.5, height, grains + 1});
        expect_right_list(bed);
      }
    }
  }
}

TEST_CASE("the list is right for grains whose sizes differ by a factor of five") {
  for (const Box& box : boxes) {
    INFO(box.length << " x " << box.width);
    SphereBed bed = testing::random_bed({box, 300, 0.1, 0.5, 3.0, 17});
    expect_right_list(bed);
  }
}

/// Every third grain small by `ratio`, so that each size meets itself and the other.
SphereBed bed_of_two_sizes(const Box& box, double ratio, std::uint64_t seed) {
  SphereBed bed = testing::random_bed({box, 400, 0.45, 0.5, 3.0, seed});
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (i % 3 != 0) bed.position[i].w *= ratio;
  }
  return bed;
}

TEST_CASE("the list is right for two sizes of any ratio in every kind of box") {
  for (const Box& box : boxes) {
    for (const double ratio : {0.9, 0.5, 0.25, 0.1, 0.02}) {
      INFO(box.length << " x " << box.width << ", ratio " << ratio);
      SphereBed bed = bed_of_two_sizes(box, ratio, 31);
      expect_right_list(bed);
      expect_right_list(bed, 0.01);
    }
  }
}

TEST_CASE("sizes far apart are searched for in levels, all the rest in one") {
  const Box box{8, 5, periodic, walls};
  SphereBed one = bed_of_two_sizes(box, 0.9, 1), two = bed_of_two_sizes(box, 0.1, 1);
  CHECK(search(one).levels.size() == 1);
  CHECK(search(two).levels.size() == 2);
  // 1, 1/2 - , 1/4 -, ...: twelve halvings, of which the smallest share the last level.
  std::vector<PlacedSphere> spheres;
  for (int k = 0; k < 12; ++k) {
    const double radius = 0.5 * std::pow(0.49, k);
    spheres.push_back({1, 1, 1 + 1.2 * k, radius});
    spheres.push_back({1 + 2 * radius, 1, 1 + 1.2 * k, radius});
  }
  SphereBed many = make_bed(box, spheres);
  CHECK(search(many).levels.size() == 8);
  expect_right_list(many);
}

TEST_CASE("the list is right for a few grains in a tall and nearly empty box") {
  for (const double height : {1e2, 1e3, 1e4}) {
    INFO("height " << height);
    SphereBed bed = testing::random_bed({{8, 5, periodic, walls}, 40, 0.3, 0.5, height, 23});
    for (std::size_t i = 0; i + 1 < 20; i += 2) {  // ten close pairs among them
      bed.position[i + 1] = bed.position[i];
      bed.position[i + 1].z += bed.position[i].w * 2 + 0.05;
    }
    expect_right_list(bed);
    CHECK(search(bed).pairs.size() >= 10);
  }
}

/// Grains on the borders of the search's cells, in the corners between them, and around.
std::vector<PlacedSphere> grains_on_borders(const Box& box, double radius) {
  const double least = 2 * radius + listed_reach;
  std::vector<PlacedSphere> spheres;
  for (const double extent : {box.length, box.width}) {
    const double size = extent / std::max(1.0, std::floor(extent / least));
    for (double x = 0; x <= extent + 0.1; x += size) {
      for (const double near : {std::nextafter(x, -1.0), x, std::nextafter(x, 100.0)}) {
        spheres.push_back({near, near / 2, radius, radius});
        spheres.push_back({near / 2, near, radius + size, radius});
      }
    }
  }
  return spheres;
}

TEST_CASE("grains on the borders of cells and of the box find their neighbours") {
  for (const Box& box : boxes) {
    for (const double radius : {0.25, 0.5}) {
      INFO(box.length << " x " << box.width << ", radius " << radius);
      SphereBed bed = make_bed(box, grains_on_borders(box, radius));
      expect_right_list(bed);
    }
  }
}

TEST_CASE("neighbours across a periodic border are found, across a wall they are not") {
  const std::vector<PlacedSphere> spheres = {
      {0.3, 0.3, 0.5, 0.5}, {7.4, 0.3, 0.5, 0.5}, {0.3, 4.4, 0.5, 0.5},  {7.4, 4.4, 0.5, 0.5},
      {-0.2, -0.2, 3, 0.5}, {8.1, 5.1, 3.9, 0.5}, {16.1, -9.9, 3.9, 0.5}};
  SphereBed both = make_bed({8, 5, periodic, periodic}, spheres);
  expect_right_list(both);
  CHECK(search(both).pairs.size() == 4 + 3);  // around the border; three above each other
  SphereBed x_only = make_bed({8, 5, periodic, walls}, {spheres.begin(), spheres.begin() + 4});
  CHECK(testing::listed_pairs(search(x_only)) == std::set<NamedPair>{{0, 1}, {2, 3}});
  SphereBed none = make_bed({8, 5, walls, walls}, {spheres.begin(), spheres.begin() + 4});
  CHECK(search(none).pairs.empty());
}

TEST_CASE("the list is the same for every instruction set") {
  const SphereBed bed = testing::random_bed({{8, 5, periodic, walls}, 400, 0.05, 0.5, 5, 29});
  SphereBed copy = bed;
  const Candidates expected = search(copy);
  REQUIRE(expected.levels.size() == 4);
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    copy = bed;
    Candidates candidates;
    wrap(copy);
    find_candidates({copy, copy.position}, listed_reach, kernels_for(isa), candidates);
    CHECK(std::equal(candidates.pairs.begin(), candidates.pairs.end(), expected.pairs.begin(),
                     expected.pairs.end(),
                     [](GrainPair p, GrainPair q) { return p.a == q.a && p.b == q.b; }));
  }
}

TEST_CASE("a list is rewritten whole when it is used again, for more and for fewer pairs") {
  Candidates candidates;
  for (const std::size_t grains : {10U, 400U, 0U, 40U}) {
    SphereBed bed = testing::random_bed({{4, 4, periodic, walls}, grains, 0.5, 0.5, 3, 31});
    wrap(bed);
    find_candidates({bed, bed.position}, listed_reach, kernels_for(best_isa()), candidates);
    CHECK(testing::listed_pairs(candidates).size() ==
          testing::pairs_closer_than(bed, listed_reach).size());
    CHECK(candidates.built_at.size() == grains);
  }
}

// --- still_complete: the list may be called complete only if it is -----------------------------

constexpr double near = 0.08;

/// One way for grains to move: adds a motion of about `size` to every grain.
using Move = void (*)(SphereBed& bed, double size, Draw& draw);

void jitter(SphereBed& bed, double size, Draw& draw) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Draw::Direction n = draw.direction();
    bed.position[i].x += size * n.x;
    bed.position[i].y += size * n.y;
    bed.position[i].z += size * n.z;
  }
}

void compact(SphereBed& bed, double size, Draw&) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.position[i].z -= size * bed.position[i].z;
  }
}

void shear(SphereBed& bed, double size, Draw&) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.position[i].x += size * bed.position[i].z;
  }
}

void one_falls(SphereBed& bed, double size, Draw&) { bed.position[0].z -= 4 * size; }

void upper_half_falls(SphereBed& bed, double size, Draw&) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.position[i].z -= bed.position[i].z > 3.0 ? 4 * size : 0.0;
  }
}

/// Moves a bed in small steps until its list is no longer called complete; as long as it is, a
/// search over all pairs must agree. Returns the steps that the list lasted.
int steps_of_a_list(const RandomScene& scene, Move move) {
  Draw draw(scene.seed);
  SphereBed bed = testing::random_bed(scene);
  Candidates candidates = search(bed);
  int steps = 0;
  for (; steps < 2000 && still_complete({bed, bed.position}, near, candidates); ++steps) {
    REQUIRE(testing::holds_all_closer_than(bed, candidates, near));
    move(bed, 0.004, draw);
  }
  return steps;
}

TEST_CASE("a list called complete holds every pair that has come near") {
  const Move moves[] = {jitter, compact, shear, one_falls, upper_half_falls};
  for (const Box& box : {boxes[0], boxes[1], boxes[2]}) {
    for (const std::size_t grains : {2U, 5U, 20U, 100U}) {
      for (std::size_t k = 0; k < std::size(moves); ++k) {
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          INFO("walls " << walls_of(box).size() << ", " << grains << " grains, motion " << k
                        << ", seed " << seed);
          CHECK(steps_of_a_list({box, grains, 0.3, 0.5, 8, seed}, moves[k]) > 0);
        }
      }
    }
  }
}

TEST_CASE("a list lasts while grains near each other move by less than its margin") {
  // Relative motion of two jittering grains is at most 2 * .004 a step, the margin .05; a layer's
  // box has a diagonal of up to sqrt(3) times that: at least three steps.
  CHECK(steps_of_a_list({{8, 5, periodic, periodic}, 100, 0.5, 0.5, 8, 1}, jitter) >= 3);
}

TEST_CASE("two grains that close in on each other need a new list after the margin, not before") {
  SphereBed bed = make_bed(boxes[0], {{1, 2, 0.5, 0.5}, {2 + listed_reach + 1e-4, 2, 0.5, 0.5}});
  Candidates candidates = search(bed);
  REQUIRE(candidates.pairs.empty());
  bed.position[0].x += 0.5 * (listed_reach - near) - 1e-4;
  bed.position[1].x -= 0.5 * (listed_reach - near) - 1e-4;
  CHECK(still_complete({bed, bed.position}, near, candidates));
  bed.position[0].x += 2e-4;
  bed.position[1].x -= 2e-4;
  CHECK_FALSE(still_complete({bed, bed.position}, near, candidates));
}

TEST_CASE("a bed that moves as a whole needs no new list") {
  for (const Box& box : {boxes[0], boxes[1]}) {
    SphereBed bed = testing::random_bed({box, 200, 0.4, 0.5, 6, 3});
    Candidates candidates = search(bed);
    CHECK(still_complete({bed, bed.position}, near, candidates));
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      bed.position[i].x += 3.7;
      bed.position[i].z += 0.9;
    }
    CHECK(still_complete({bed, bed.position}, near, candidates));
  }
}

TEST_CASE("a bed that falls as a whole needs a new list when its grains come near the floor") {
  SphereBed bed = make_bed(boxes[0], {{1, 2, 3, 0.5}, {3, 2, 4, 0.5}});
  Candidates candidates = search(bed);
  for (Record<double>* p : {&bed.position[0], &bed.position[1]}) {
    p->z -= 2.4;
  }
  CHECK(still_complete({bed, bed.position}, near, candidates));
  for (Record<double>* p : {&bed.position[0], &bed.position[1]}) {
    p->z -= 0.05;
  }
  CHECK_FALSE(still_complete({bed, bed.position}, near, candidates));
}

TEST_CASE("a grain that falls through empty air to another one is seen to come near") {
  SphereBed bed = make_bed(boxes[0], {{1, 2, 0.5, 0.5}, {1, 2, 9, 0.5}});
  Candidates candidates = search(bed);
  REQUIRE(candidates.pairs.empty());
  while (bed.position[1].z > 1.5 + near && still_complete({bed, bed.position}, near, candidates)) {
    bed.position[1].z -= 0.01;
  }
  CHECK(bed.position[1].z > 1.5 + near - 0.011);
  CHECK_FALSE(still_complete({bed, bed.position}, near, candidates));
}

// Layers are one cell, here 2 r + reach = 1.13 high and what rounding adds. The middle grain stays,
// so that neither of the others moves by more than the margin relative to its own neighbouring
// layer.
TEST_CASE("grains two layers apart that approach each other are seen to come near") {
  const double layer = 1 + listed_reach + 4e-5, tiny = 1e-9;
  SphereBed bed = make_bed(boxes[0], {{7, 2, 0.5, 0.5},
                                      {1, 2, 0.5 + layer - tiny, 0.5},
                                      {5, 2, 0.5 + 1.5 * layer, 0.5},
                                      {1, 2, 0.5 + 2 * layer + tiny, 0.5},
                                      {7, 2, 0.5 + 4 * layer, 0.5}});
  Candidates candidates = search(bed);
  REQUIRE(candidates.pairs.empty());
  bed.position[1].z += 0.045;
  bed.position[3].z -= 0.045;
  REQUIRE(testing::gap_of(bed, 1, 3) < near);
  CHECK_FALSE(still_complete({bed, bed.position}, near, candidates));
}

}  // namespace
}  // namespace grainsweep
