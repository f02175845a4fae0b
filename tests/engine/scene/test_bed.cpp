#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "engine/scene/bed.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

SphereBed bed_of(const std::vector<PlacedSphere>& spheres, Boundary y = walls) {
  return make_bed({10, 5, periodic, y}, spheres);
}

TEST_CASE("a bed holds its spheres, the wall and two void grains") {
  const SphereBed bed = bed_of({{1, 2, 3, 0.5}, {4, 4, 4, 0.25}});
  REQUIRE(bed.grains() == 2);
  REQUIRE(bed.position.size() == 5);
  REQUIRE(bed.motion.size() == 5);
  CHECK(bed.wall() == 2);
  CHECK(bed.void_a() == 3);
  CHECK(bed.void_b() == 4);
  CHECK(testing::same_bits(bed.position[1], Record<double>{4, 4, 4, 0.25}));
}

TEST_CASE("each subdomain of a large bed has a wall and two void grains of its own") {
  const SphereBed bed = bed_of(std::vector<PlacedSphere>(large_bed_grains<Sphere>, {1, 2, 3, 0.5}));
  REQUIRE(bed.grains() == large_bed_grains<Sphere>);
  REQUIRE(bed.subdomains > 1);
  std::set<std::int32_t> entries;
  for (std::size_t subdomain = 0; subdomain < bed.subdomains; ++subdomain) {
    CHECK(bed.motion[static_cast<std::size_t>(bed.wall(subdomain))].w == 0.0);
    CHECK_FALSE(bed.is_void(bed.wall(subdomain)));
    CHECK(bed.is_void(bed.void_a(subdomain)));
    entries.insert({bed.wall(subdomain), bed.void_a(subdomain), bed.void_b(subdomain)});
  }
  CHECK(entries.size() == 3 * bed.subdomains);
  CHECK(*entries.begin() == bed.wall());
  CHECK(static_cast<std::size_t>(*entries.rbegin()) == bed.position.size() - 1);
}

TEST_CASE("flat beds are cut along x or y, others upwards") {
  const Box box{30, 20, periodic, walls};
  CHECK(subdomain_axis(box, 0.6 * 30 * 20 * 19) == 0);
  CHECK(subdomain_axis({20, 30, periodic, walls}, 0.6 * 30 * 20 * 19) == 1);
  CHECK(subdomain_axis(box, 0.6 * 30 * 20 * 21) == 2);
}

TEST_CASE("a sphere of diameter 1 has mass 1, one of half the size an eighth") {
  const SphereBed bed = bed_of({{1, 2, 3, 0.5}, {4, 4, 4, 0.25}});
  CHECK(bed.motion[0].w == 1.0);
  CHECK(bed.motion[1].w == 8.0);
}

TEST_CASE("nothing moves the wall, and the void is far from everything and from itself") {
  const SphereBed bed = bed_of({{1, 2, 3, 0.5}});
  CHECK(bed.motion[1].w == 0.0);
  CHECK(bed.motion[2].w > 0.0);
  CHECK(bed.motion[3].w > 0.0);
  CHECK(bed.position[2].z < -1e8);
  CHECK(std::abs(bed.position[3].z - bed.position[2].z) > 1e8);
}

TEST_CASE("a bed may be empty") {
  CHECK(bed_of({}).grains() == 0);
  CHECK(bed_of({}).position.size() == 3);
}

TEST_CASE("wrapping brings grains back along periodic axes only") {
  SphereBed bed = bed_of({{-1, -1, 3, 0.5}, {10, 5, 1, 0.5}, {27.5, 6, -2, 0.5}});
  wrap(bed);
  CHECK(testing::same_bits(bed.position[0], Record<double>{9, -1, 3, 0.5}));
  CHECK(testing::same_bits(bed.position[1], Record<double>{0, 5, 1, 0.5}));
  CHECK(testing::same_bits(bed.position[2], Record<double>{7.5, 6, -2, 0.5}));
}

TEST_CASE("wrapped coordinates lie in the box, however close to its border") {
  for (const double x : {-1e-300, -1e-20, std::nextafter(10.0, 0.0), 10.0, -10.0, 1e6, -1e6}) {
    INFO(x);
    SphereBed bed = bed_of({{x, x, 1, 0.5}}, periodic);
    wrap(bed);
    CHECK(bed.position[0].x >= 0.0);
    CHECK(bed.position[0].x < 10.0);
    CHECK(bed.position[0].y >= 0.0);
    CHECK(bed.position[0].y < 5.0);
  }
}

TEST_CASE("wrapping leaves the wall and the void alone") {
  SphereBed bed = bed_of({{11, 2, 3, 0.5}}, periodic);
  const auto before = bed.position;
  wrap(bed);
  for (std::size_t i = 1; i < 4; ++i) {
    CHECK(testing::same_bits(bed.position[i], before[i]));
  }
}

TEST_CASE("the state hash changes with the last bit of every coordinate and radius") {
  const SphereBed bed = testing::random_bed({{10, 5, periodic, walls}, 20, 0.4, 0.5, 5, 3});
  const std::uint64_t hash = state_hash(bed);
  CHECK(state_hash(SphereBed(bed)) == hash);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    for (double Record<double>::*column :
         {&Record<double>::x, &Record<double>::y, &Record<double>::z, &Record<double>::w}) {
      SphereBed other = bed;
      other.position[i].*column = std::nextafter(other.position[i].*column, 100.0);
      CHECK(state_hash(other) != hash);
    }
  }
}

TEST_CASE("the state hash depends on the order of the grains") {
  CHECK(state_hash(bed_of({{1, 2, 3, 0.5}, {4, 4, 4, 0.5}})) !=
        state_hash(bed_of({{4, 4, 4, 0.5}, {1, 2, 3, 0.5}})));
  CHECK(state_hash(bed_of({})) != state_hash(bed_of({{0, 0, 0, 0}})));
}

}  // namespace
}  // namespace grainsweep
