#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/measure/contact_forces.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

// A mean square of 2 has a standard error of sqrt(20 / 40000); densities are counts.
TEST_CASE("forces are taken relative to their layer, whose mean grows with depth") {
  std::mt19937_64 generator(3);
  std::exponential_distribution<double> exponential;
  std::vector<PairForce> forces;
  for (int k = 0; k < 40000; ++k) {
    const double height = 3 + k % 10 + 0.5;
    forces.push_back({0, 1, (20 - height) * exponential(generator), height});
  }
  const ForceStatistics statistics = force_statistics(forces, {3, 13}, 0.1, 8);
  CHECK(statistics.mean == Approx(12).epsilon(0.02));
  CHECK(statistics.square == about(2, 0.09));
  REQUIRE(statistics.density.values.size() == 80);
  double sum = 0;
  for (std::size_t k = 0; k < 80; ++k) {
    const double low = 0.1 * double(k);
    const double exact = (std::exp(-low) - std::exp(-low - 0.1)) / 0.1;
    const double noise = std::sqrt(exact / 0.1 / 40000);
    CHECK(statistics.density.values[k] == about(exact, 4.5 * noise + 2e-4));
    sum += statistics.density.values[k] * 0.1;
  }
  CHECK(sum == about(1 - std::exp(-8.0), 2e-4));
}

TEST_CASE("forces outside the slab do not count, and none at all give no mean") {
  const std::vector<PairForce> forces = {{0, 1, 5, 2.9}, {1, 2, 1, 3.0}, {2, 3, 7, 4.0}};
  const ForceStatistics statistics = force_statistics(forces, {3, 4}, 0.5, 2);
  CHECK(statistics.mean == 1);
  CHECK(statistics.density.values == std::vector<double>{0, 0, 2, 0});
  CHECK(std::isnan(force_statistics({}, {3, 4}, 0.5, 2).mean));
}

}  // namespace
}  // namespace grainsweep
