#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/bond_order.hpp"
#include "engine/measure/order.hpp"
#include "tests/support/about.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

TEST_CASE("walls and floor count among the contacts of a grain") {
  // A row of three at a wall: ends touch one grain, wall and floor, the middle one two.
  SphereBed bed = make_bed({9, 4, periodic, walls},
                           {{1, 0.5, 0.5, 0.5}, {2, 0.5, 0.5, 0.5}, {3, 0.5, 0.5, 0.5}});
  const Touching touching = find_touching(bed, 1e-3, kernels_for(best_isa()));
  CHECK(share_with_contacts(bed, touching, {0, 1}, 1e-4, 3) == Approx(2.0 / 3.0));
  CHECK(share_with_contacts(bed, touching, {0, 1}, 1e-4, 4) == Approx(1.0 / 3.0));
  CHECK(share_with_contacts(bed, touching, {0, 1}, 1e-4, 5) == 0);
  CHECK(std::isnan(share_with_contacts(bed, touching, {2, 3}, 1e-4, 3)));
}

TEST_CASE("segregation is the rise of the small grains over the large ones in slab heights") {
  const SphereBed bed = make_bed(
      {9, 4, periodic, walls},
      {{1, 1, 2, 0.5}, {1, 1, 4, 0.5}, {5, 1, 5, 0.25}, {7, 1, 6, 0.25}, {8, 1, 20, 0.25}});
  CHECK(segregation(bed, {0, 10}, 0.4) == Approx(0.25));
  CHECK(segregation(bed, {0, 10}, 0.5) == Approx(0.25));  // at the limit grains are large
  CHECK(std::isnan(segregation(bed, {0, 10}, 0.25)));
  CHECK(std::isnan(segregation(bed, {0, 10}, 0.1)));
  CHECK(std::isnan(segregation(bed, {0, 10}, 0.6)));
}

TEST_CASE("a crystal at rest has its order, its forces and its distances") {
  SphereBed bed = testing::fcc_bed(3, 3, 5);
  const Touching touching = find_touching(bed, longest_bond_gap, kernels_for(best_isa()));
  const std::vector<PairForce> forces = {{0, 1, 1.0, 2.0}, {1, 2, 3.0, 3.0}};
  Curves curves;
  const Order order = measure_order(bed, touching, forces, {1.2, 5.2}, {0, 1e-4}, curves);
  CHECK(order.q6_global == about(0.574524, 1e-6));
  CHECK(order.three_contact_share == 0);
  CHECK(std::isnan(order.segregation));
  CHECK(curves.pair_correlation.bin_width == 0.05);
  CHECK(curves.pair_correlation.values.at(20) + curves.pair_correlation.values.at(19) > 5);
  CHECK(order.force_mean == Approx(2));
  CHECK(curves.force_density.values.size() == 80);
}

}  // namespace
}  // namespace grainsweep
