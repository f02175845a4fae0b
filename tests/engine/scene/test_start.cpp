#include <algorithm>
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "engine/results.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

PackingSpec spec_of(const Box& box, std::int64_t grains, const SizesSpec& sizes = {},
                    std::uint64_t key = 1) {
  PackingSpec spec;
  spec.box = box;
  spec.fill = GrainCount{grains};
  spec.sizes = sizes;
  spec.random_key = key;
  return spec;
}

double top_of(const SphereBed& bed) {
  double top = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    top = std::max(top, bed.position[i].z + bed.position[i].w);
  }
  return top;
}

TEST_CASE("grains start apart from each other and from all walls") {
  const SizesSpec two_sizes{0.1, 0.3, 0.3};
  for (const Box& box :
       {Box{6, 4, periodic, walls}, Box{6, 4, periodic, periodic}, Box{6, 4, walls, periodic},
        Box{6, 4, walls, walls}, Box{3, 3, periodic, periodic}, Box{2.9, 1.45, walls, walls},
        Box{9, 1.45, periodic, walls}}) {
    for (const std::int64_t grains : {1, 2, 60, 400}) {
      INFO(box.length << " x " << box.width << ", " << grains << " grains");
      const auto bed = start<Sphere>(spec_of(box, grains, two_sizes));
      REQUIRE(bed);
      REQUIRE(bed->grains() == static_cast<std::size_t>(grains));
      CHECK(testing::pairs_closer_than(*bed, 0.0).empty());
      for (const Wall& wall : bed->walls) {
        for (std::size_t i = 0; i < bed->grains(); ++i) {
          REQUIRE(wall.gap(bed->position[i]) >= -1e-15);  // one rounding
        }
      }
    }
  }
}

TEST_CASE("walls any distance apart and shafts of any width have room for a start") {
  // Between walls 1.5 to 1.85 d apart random grains jam in the air below the usual solid fraction.
  for (const double width : {1.0, 1.05, 1.5, 1.707, 1.85, 2.0}) {
    for (const auto& [length, x] : {std::pair(12.0, periodic), std::pair(2.0, walls)}) {
      for (std::uint64_t key = 1; key <= testing::tries(4U); ++key) {
        INFO(length << " x " << width << ", key " << key);
        const auto bed = start<Sphere>(spec_of({length, width, x, walls}, 200, {0, 0, 0.5}, key));
        REQUIRE(bed);
        REQUIRE(bed->grains() == 200);
        CHECK(testing::pairs_closer_than(*bed, 0.0).empty());
      }
    }
  }
}

TEST_CASE("grains start apart from each other and from the wall of any tube") {
  for (const double diameter : {1.0, 1.05, 1.7, 1.86, 1.87, 2.0, 3.3, 9.0}) {
    for (const double spread : {0.0, 0.02}) {
      INFO("D = " << diameter << ", spread " << spread);
      const double room = diameter + 2 * spread * 3;
      const auto bed = start<Sphere>(spec_of(tube_of(room), 200, {spread, 0, 0.5}));
      REQUIRE(bed);
      REQUIRE(bed->grains() == 200);
      CHECK(testing::pairs_closer_than(*bed, 0.0).empty());
      for (const Wall& wall : bed->walls) {
        for (std::size_t i = 0; i < bed->grains(); ++i) {
          REQUIRE(wall.gap(bed->position[i]) >= -1e-15 * room);  // one rounding
        }
      }
    }
  }
}

TEST_CASE("grains in single file start in one plane, turned by the key") {
  const Box tube = tube_of(1.6);
  double angles[2] = {};
  for (const std::uint64_t key : {1U, 2U}) {
    const auto bed = start<Sphere>(spec_of(tube, 50, {0, 0, 0.5}, key));
    REQUIRE(bed);
    const Record<double>& first = bed->position[0];
    const double x = first.x - 0.8, y = first.y - 0.8;
    angles[key - 1] = std::atan2(y, x);
    for (std::size_t i = 0; i < bed->grains(); ++i) {
      const Record<double>& p = bed->position[i];
      const double side = i % 2 == 0 ? 1 : -1;
      CHECK(p.x - 0.8 == about(side * x, 1e-15));
      CHECK(p.y - 0.8 == about(side * y, 1e-15));
    }
  }
  CHECK(std::abs(angles[0] - angles[1]) > 0.1);
}

// Each touches the next but one where D = 1 + sqrt(3) / 2 times its diameter: 1.866.
TEST_CASE("only tubes in which no grain lies beside the next but one are filled in single file") {
  const auto is_in_file = [](double diameter, const SizesSpec& sizes) {
    const auto bed = start<Sphere>(spec_of(tube_of(diameter), 50, sizes));
    REQUIRE(bed);
    double lowest = 0.0;
    for (std::size_t i = 0; i < bed->grains(); ++i) {
      // Those of a file lie at the wall, higher than the one before.
      const Record<double>& p = bed->position[i];
      if (std::abs(bed->walls[tube_wall].gap(p)) > 1e-12 || p.z < lowest + 1.0) return false;
      lowest = p.z;
    }
    return true;
  };
  CHECK(is_in_file(1.866, {0, 0, 0.5}));
  CHECK_FALSE(is_in_file(1.867, {0, 0, 0.5}));
  // Of small grains the tube holds more side by side.
  CHECK(is_in_file(1.49, {0, 0.1, 0.8}));
  CHECK_FALSE(is_in_file(1.5, {0, 0.1, 0.8}));
}

TEST_CASE("grains in single file do not stand evenly") {
  const auto bed = start<Sphere>(spec_of(tube_of(1.6), 3, {0, 0, 0.5}));
  REQUIRE(bed);
  const auto apart = [&](std::size_t i) { return bed->position[i + 1].z - bed->position[i].z; };
  CHECK(std::abs(apart(0) - apart(1)) > 1e-4);
}

TEST_CASE("sizes are mixed in single file, in which grains cannot pass each other") {
  PackingSpec spec = spec_of(tube_of(1.4), 400, {0, 0.4, 0.9}, 3);
  std::vector<double> drawn = draw_radii(spec), found;
  const auto bed = start<Sphere>(spec);
  REQUIRE(bed);
  double heights = 0.0, large = 0.0;  // mean number of a large grain, from the floor
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    found.push_back(bed->position[i].w);
    if (found.back() == 0.5) heights += static_cast<double>(i), large += 1.0;
  }
  // 200 of 400 numbers, drawn without return: a mean of 199.5 +- 5.8, four deviations here.
  CHECK(heights / large == about(199.5, 4 * 400 / std::sqrt(12.0 * large)));
  std::sort(drawn.begin(), drawn.end());
  std::sort(found.begin(), found.end());
  CHECK(found == drawn);
}

TEST_CASE("grains ten times smaller start apart from large ones, whichever came first") {
  // A spread of .2 makes some grains of the large class smaller than half of the largest.
  for (const SizesSpec& sizes : {SizesSpec{0.03, 0.1, 0.1}, SizesSpec{0.2, 0.02, 0.1}}) {
    const auto bed = start<Sphere>(spec_of({3, 3, periodic, walls}, 2500, sizes));
    REQUIRE(bed);
    CHECK(testing::pairs_closer_than(*bed, 0.0).empty());
  }
  std::vector<double> small_ones_first(100, 0.05);
  small_ones_first.insert(small_ones_first.end(), 10, 0.5);
  const Box box{3, 3, periodic, walls};
  const auto placed = place_at_random(box, small_ones_first, 3, 1);
  REQUIRE(placed);
  const std::vector<PlacedSphere> spheres(placed->begin(), placed->end());
  CHECK(testing::pairs_closer_than(make_bed(box, spheres), 0.0).empty());
}

// Cells of small grains alone would be 1e10 here.
TEST_CASE("few small grains in a wide box start in as few cells") {
  PackingSpec spec = spec_of({1966, 1966, periodic, periodic}, 1000, {0.0, 0.5, 0.03});
  const auto bed = start<Sphere>(spec);
  REQUIRE(bed);
  CHECK(bed->grains() == 1000);
  CHECK(testing::pairs_closer_than(*bed, 0.0).empty());
}

TEST_CASE("grains fill a column of the start's solid fraction") {
  const auto bed = start<Sphere>(spec_of({8, 8, periodic, periodic}, 800));
  REQUIRE(bed);
  double solid = 0;
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    solid += sphere_volume(bed->position[i].w);
  }
  // The highest of 800 grains comes within a few percent of the top.
  const double fraction = solid / (64 * top_of(*bed));
  CHECK(fraction == Approx(sphere_start_solid_fraction).epsilon(0.02));
  CHECK(fraction >= sphere_start_solid_fraction - 1e-12);
}

TEST_CASE("grains are numbered from the floor up, layer by layer of at most two diameters") {
  const auto bed = start<Sphere>(spec_of({8, 4, periodic, walls}, 500));
  REQUIRE(bed);
  double highest = 0;
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    highest = std::max(highest, bed->position[i].z);
    REQUIRE(bed->position[i].z > highest - 2.0);
  }
}

TEST_CASE("grains start at rest with the sizes drawn for them") {
  const auto bed = start<Sphere>(spec_of({8, 4, periodic, walls}, 100));
  REQUIRE(bed);
  for (std::size_t i = 0; i < bed->grains(); ++i) {
    const Record<double>& motion = bed->motion[i];
    CHECK((motion.x == 0 && motion.y == 0 && motion.z == 0));
    CHECK(motion.w == Approx(1 / sphere_mass(bed->position[i].w)));
  }
}

TEST_CASE("equal keys start alike, different keys do not") {
  const Box box{8, 4, periodic, walls};
  const auto a = start<Sphere>(spec_of(box, 200, {}, 7)),
             b = start<Sphere>(spec_of(box, 200, {}, 7)),
             c = start<Sphere>(spec_of(box, 200, {}, 8));
  REQUIRE((a && b && c));
  CHECK(testing::same_bits(a->position, b->position));
  CHECK_FALSE(testing::same_bits(a->position, c->position));
}

TEST_CASE("placed grains are taken as they are, in their order") {
  PackingSpec spec;
  const std::vector<PlacedSphere> spheres = {{5, 5, 9, 0.5}, {1, 2, 0.25, 0.25}};
  spec.fill = PlacedGrains{spheres};
  const auto bed = start<Sphere>(spec);
  REQUIRE(bed);
  CHECK(testing::same_bits(bed->position, make_bed(bed->box, spheres).position));
}

TEST_CASE("a grain larger than the gap between the walls gives no bed") {
  CHECK_FALSE(start<Sphere>(spec_of({8, 0.99, periodic, walls}, 1, {0, 0, 0.5})));
  CHECK_FALSE(start<Sphere>(spec_of({0.99, 8, walls, periodic}, 1, {0, 0, 0.5})));
  CHECK(start<Sphere>(spec_of({8, 1, periodic, walls}, 1, {0, 0, 0.5})));
}

TEST_CASE("no grains give an empty bed") {
  const auto bed = start<Sphere>(spec_of({8, 4, periodic, walls}, 0));
  REQUIRE(bed);
  CHECK(bed->grains() == 0);
}

}  // namespace
}  // namespace grainsweep
