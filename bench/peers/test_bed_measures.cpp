#include <cmath>

#include <catch2/catch.hpp>

#include "bench/peers/bed_measures.hpp"
#include "engine/units.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep::bench {
namespace {

using testing::periodic;
using testing::walls;

/// 4 x 4 x 10 spheres of diameter 1 + growth at the points of a cubic lattice of spacing 1, between
/// walls along y: 424 pairs, 80 contacts with walls and 16 with the floor.
SphereBed walled_lattice(double growth) {
  std::vector<PlacedSphere> spheres;
  for (int i = 0; i < 160; ++i) {
    const double x = i % 4, y = i / 4 % 4, z = i / 16;
    spheres.push_back({x + 0.5, y + 0.5, z + 0.5, 0.5 + growth / 2.0});
  }
  return make_bed({4, 4, periodic, walls}, spheres);
}

BedMeasures measured(SphereBed bed) { return measures_of(bed, {}, kernels_for(best_isa())); }

TEST_CASE("a cubic lattice between walls has its exact solid fraction, neighbours and contacts") {
  const BedMeasures lattice = measured(walled_lattice(0.0));
  CHECK(lattice.grains == 160);
  CHECK(lattice.solid_fraction == Approx(pi / 6.0).epsilon(1e-13));  // 64 volumes are summed
  CHECK(lattice.coordination.between_grains == 5.5);
  CHECK(lattice.coordination.with_walls == 6.0);
  CHECK(lattice.overlapping == 520);
  CHECK(lattice.near == 520);
  CHECK(lattice.isostatic == 3 * 160 - 1);  // all slide together along x
  CHECK(lattice.overlap_mean == 0.0);
  CHECK(lattice.overlap_max == 0.0);
}

TEST_CASE("grains pressed together overlap by what they are too large") {
  const BedMeasures pressed = measured(walled_lattice(0.001));
  const double rounding = 1e-12;  // relative: gaps of 1e-3 are differences of numbers near 10
  CHECK(pressed.overlapping == 520);
  CHECK(pressed.overlap_max == Approx(0.001).epsilon(rounding));
  CHECK(pressed.overlap_mean == Approx((424 * 0.001 + 96 * 0.0005) / 520).epsilon(rounding));
}

TEST_CASE("near contacts need not overlap, and farther ones are none") {
  const BedMeasures near = measured(walled_lattice(-5e-5)), far = measured(walled_lattice(-3e-4));
  CHECK(near.overlapping == 0);
  CHECK(near.near == 520);
  CHECK(near.overlap_mean == 0.0);
  CHECK(far.near == 0);
}

TEST_CASE("a grain alone on the floor is held by one contact and slides along both axes") {
  const BedMeasures lone = measured(make_bed({4, 4, periodic, walls}, {{2, 2, 0.4999, 0.5}}));
  CHECK(lone.overlapping == 1);
  CHECK(lone.isostatic == 1);
  CHECK(std::isnan(lone.solid_fraction));  // too low to hold a slab
  CHECK(std::isnan(lone.coordination.between_grains));
}

}  // namespace
}  // namespace grainsweep::bench
