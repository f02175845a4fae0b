#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/broad/candidates.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/tries.hpp"

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
    const std::vector<std::int32_t>& near = candidates.walls[k];
    REQUIRE(std::is_sorted(near.begin(), near.end()));
    for (const std::int32_t grain : near) {
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
    for (const std::size_t grains :
         {0U, 1U, 2U, 3U, 10U, 150U, testing::is_sanitized ? 125U : 500U}) {
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
SphereBed bed_of_two_sizes(const Box& box, double ratio, std::uint64_t seed,
                           std::size_t grains = 400) {
  SphereBed bed = testing::random_bed({box, grains, 0.45, 0.5, 3.0, seed});
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
  const Candidates candidates = search(bed);
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

TEST_CASE("a list lasts while no grain moves by more than half its margin") {
  SphereBed bed = make_bed(boxes[0], {{1, 2, 0.5, 0.5}, {2 + listed_reach + 1e-4, 2, 0.5, 0.5}});
  const Candidates candidates = search(bed);
  REQUIRE(candidates.pairs.empty());
  bed.position[0].x += 0.5 * (listed_reach - near) - 1e-4;
  bed.position[1].x -= 0.5 * (listed_reach - near) - 1e-4;
  CHECK(still_complete({bed, bed.position}, near, candidates));
  bed.position[0].x += 2e-4;
  bed.position[1].x -= 2e-4;
  CHECK_FALSE(still_complete({bed, bed.position}, near, candidates));
}

TEST_CASE("no list is complete for pairs further apart than it reaches") {
  SphereBed bed = testing::random_bed({boxes[0], 20, 0.3, 0.5, 4, 3});
  const Candidates candidates = search(bed);
  CHECK(still_complete({bed, bed.position}, listed_reach, candidates));
  CHECK_FALSE(still_complete({bed, bed.position}, listed_reach + 1e-9, candidates));
}

// --- complete_candidates: strays are looked up singly -------------------------------------------

/// How often the list was made anew, added to and left, over many small steps; after each it must
/// hold every pair and wall that is near, and no pair twice.
struct Changes {
  int whole = 0, added = 0, none = 0;
};

Changes changes_of_a_list(SphereBed bed, Move move, double size, int steps) {
  Draw draw(7);
  Candidates candidates;
  Changes changes;
  for (int step = 0; step < steps; ++step) {
    const bool is_new = complete_candidates(near, 0.09, kernels_for(best_isa()), bed, candidates);
    ++(is_new ? changes.whole : candidates.strays.empty() ? changes.none : changes.added);
    REQUIRE(testing::holds_all_closer_than(bed, candidates, near));
    move(bed, size, draw);
  }
  return changes;
}

/// A tenth of the grains moves five times as far as the others.
void some_stray(SphereBed& bed, double size, Draw& draw) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Draw::Direction n = draw.direction();
    const double way = i % 10 == 3 ? 5 * size : size;
    bed.position[i].x += way * n.x + (i % 10 == 3 ? size : 0.0);
    bed.position[i].y += way * n.y;
    bed.position[i].z = std::abs(bed.position[i].z + way * n.z);
  }
}

TEST_CASE("a list to which strays are added holds every pair that has come near, none twice") {
  const Move moves[] = {jitter, compact, shear, one_falls, some_stray};
  for (const Box& box : {boxes[0], boxes[1], boxes[2], boxes[7]}) {
    for (const double ratio : {1.0, 0.5, 0.15, 0.05}) {
      for (std::size_t k = 0; k < std::size(moves); ++k) {
        INFO("walls " << walls_of(box).size() << ", ratio " << ratio << ", motion " << k);
        const Changes changes =
            changes_of_a_list(bed_of_two_sizes(box, ratio, 5 + k, 120), moves[k], 0.004, 60);
        CHECK(changes.whole >= 1);
      }
    }
  }
}

TEST_CASE("pairs of grains below a quarter of the largest are listed less far, all others not") {
  const auto listed = [](double one, double other, double gap) {
    SphereBed bed =
        make_bed(boxes[2], {{4, 2, 1, one}, {4, 2, 1 + one + other + gap, other}, {1, 1, 4, 0.5}});
    Candidates candidates;
    complete_candidates(0.03, 0.08, kernels_for(best_isa()), bed, candidates);
    return !candidates.pairs.empty();
  };
  CHECK(listed(0.5, 0.5, 0.109));
  CHECK(listed(0.5, 0.125, 0.109));
  CHECK(listed(0.5, 0.05, 0.08));  // 0.03, 0.04 of the large and 0.016 of the small one
  CHECK_FALSE(listed(0.5, 0.05, 0.09));
  CHECK(listed(0.05, 0.05, 0.06));
  CHECK_FALSE(listed(0.05, 0.05, 0.065));
}

TEST_CASE("where few grains stray the bed is not searched anew") {
  const Changes changes = changes_of_a_list(testing::random_bed({boxes[1], 400, 0.5, 0.5, 8, 2}),
                                            some_stray, 0.002, 150);
  CHECK(changes.added > 50);
  CHECK(changes.whole < 15);
}

TEST_CASE("a grain that falls through empty air to another one is seen to come near") {
  SphereBed bed = make_bed(boxes[0], {{1, 2, 0.5, 0.5}, {1, 2, 9, 0.5}});
  Candidates candidates;
  while (bed.position[1].z > 1.5 + near) {
    complete_candidates(near, 0.09, kernels_for(best_isa()), bed, candidates);
    bed.position[1].z -= 0.1;
  }
  complete_candidates(near, 0.09, kernels_for(best_isa()), bed, candidates);
  CHECK(candidates.pairs.size() == 1);
}

TEST_CASE("grains that stray are found by those asleep that they sink to") {
  SphereBed bed = testing::random_bed({boxes[0], 300, 0.4, 0.5, 12, 11});
  bed.asleep.assign(bed.grains(), 0);
  for (std::size_t i = 0; i < bed.grains(); ++i) bed.asleep[i] = bed.position[i].z < 6.0;
  Candidates candidates;
  for (int step = 0; step < 60; ++step) {
    complete_candidates(near, 0.09, kernels_for(best_isa()), bed, candidates);
    const std::set<NamedPair> listed = testing::listed_pairs(candidates);
    for (const NamedPair& pair : testing::pairs_closer_than(bed, near)) {
      const auto a = static_cast<std::size_t>(pair.first),
                 b = static_cast<std::size_t>(pair.second);
      if (!bed.is_asleep(a) || !bed.is_asleep(b)) REQUIRE(listed.count(pair) == 1);
    }
    for (std::size_t i = 0; i < bed.grains(); i += 20) {
      if (!bed.is_asleep(i)) bed.position[i].z -= 0.07;
    }
  }
}

TEST_CASE("an index knows the pairs that it was given, and no others") {
  PairIndex index;
  index.assign(5, {{0, 1}, {0, 3}, {2, 4}});
  index.add({0, 4});
  for (std::int32_t a = 0; a < 5; ++a) {
    for (std::int32_t b = a + 1; b < 5; ++b) {
      const bool known = (a == 0 && (b == 1 || b == 3 || b == 4)) || (a == 2 && b == 4);
      CHECK(index.holds({a, b}) == known);
    }
  }
  index.assign(5, {});
  CHECK_FALSE(index.holds({0, 1}));
}

}  // namespace
}  // namespace grainsweep
