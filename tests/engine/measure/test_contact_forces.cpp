#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/measure/contact_forces.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

const Kernels& kernels() { return kernels_for(best_isa()); }

// The solve may miss each row by 1e-3 m g of relative motion, and what one row misses all below it
// carry: up to 2e-3 (1 + 2 + .. + 6) = .042.
TEST_CASE("each contact of a column carries the weight of the grains above it") {
  const SphereBed bed = testing::column_bed(6, 0.0);
  const auto forces = pair_forces(bed, kernels(), 0.1);
  REQUIRE(forces.size() == 5);
  for (const PairForce& force : forces) {
    CHECK(force.b == force.a + 1);
    CHECK(force.height == Approx(force.a + 1.0));
    CHECK(force.magnitude == Approx(5.0 - force.a).margin(0.042));
  }
}

TEST_CASE("grains that lie side by side exert no force on each other") {
  const SphereBed bed =
      make_bed({4, 4, Boundary::periodic, Boundary::walls}, {{1, 1, 0.5, 0.5}, {2, 1, 0.5, 0.5}});
  CHECK(pair_forces(bed, kernels(), 0.1).empty());
}

// Two grains between walls .9 apart beyond a diameter hold a third one up: f = 1/2 / sin(angle).
TEST_CASE("a grain on two others shares its weight between them") {
  const double rise = 0.6, half = 0.8;
  const SphereBed bed = make_bed(
      {6, 1 + 2 * half, Boundary::periodic, Boundary::walls},
      {{3, 0.5, 0.5, 0.5}, {3, 0.5 + 2 * half, 0.5, 0.5}, {3, 0.5 + half, 0.5 + rise, 0.5}});
  const auto forces = pair_forces(bed, kernels(), 0.1);
  REQUIRE(forces.size() == 2);
  for (const PairForce& force : forces) CHECK(force.magnitude == Approx(0.5 / 0.6).margin(5e-3));
}

TEST_CASE("the bed stays where it is") {
  const SphereBed bed = testing::column_bed(3, 0.0);
  const std::uint64_t before = state_hash(bed);
  pair_forces(bed, kernels(), 0.1);
  CHECK(state_hash(bed) == before);
}

// A mean square of 2 has a standard error of sqrt(20 / 40000); densities are counts.
TEST_CASE("forces are taken relative to their layer, whose mean grows with depth") {
  std::mt19937_64 generator(3);
  std::exponential_distribution<double> exponential;
  std::vector<PairForce> forces;
  for (int k = 0; k < 40000; ++k) {
    const double height = 3 + k % 10 + 0.5;
    forces.push_back({0, 1, height, (20 - height) * exponential(generator)});
  }
  const ForceStatistics statistics = force_statistics(forces, {3, 13}, 0.1, 8);
  CHECK(statistics.mean == Approx(12).epsilon(0.02));
  CHECK(statistics.square == Approx(2).margin(0.09));
  REQUIRE(statistics.density.values.size() == 80);
  double sum = 0;
  for (std::size_t k = 0; k < 80; ++k) {
    const double low = 0.1 * double(k);
    const double exact = (std::exp(-low) - std::exp(-low - 0.1)) / 0.1;
    const double noise = std::sqrt(exact / 0.1 / 40000);
    CHECK(statistics.density.values[k] == Approx(exact).margin(4.5 * noise + 2e-4));
    sum += statistics.density.values[k] * 0.1;
  }
  CHECK(sum == Approx(1 - std::exp(-8.0)).margin(2e-4));
}

TEST_CASE("forces outside the slab do not count, and none at all give no mean") {
  const std::vector<PairForce> forces = {{0, 1, 2.9, 5}, {1, 2, 3.0, 1}, {2, 3, 4.0, 7}};
  const ForceStatistics statistics = force_statistics(forces, {3, 4}, 0.5, 2);
  CHECK(statistics.mean == 1);
  CHECK(statistics.density.values == std::vector<double>{0, 0, 2, 0});
  CHECK(std::isnan(force_statistics({}, {3, 4}, 0.5, 2).mean));
}

}  // namespace
}  // namespace grainsweep
