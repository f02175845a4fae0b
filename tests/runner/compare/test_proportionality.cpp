#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "runner/compare/proportionality.hpp"

namespace grainsweep {
namespace {

TEST_CASE("points on a line through zero give its slope and no chi2") {
  const auto fit = fit_proportionality({{1, 0.1, 3, 0.1}, {2, 0.1, 6, 0.2}, {4, 0.2, 12, 0.1}});
  CHECK(fit.slope == Approx(3));
  CHECK(fit.chi2_per_dof == Approx(0).margin(1e-20));
}

// Exact x: slope = sum w x y / sum w x^2 and error = 1 / sqrt(sum w x^2), worked by hand.
TEST_CASE("with exact x the fit is the weighted one") {
  const auto fit = fit_proportionality({{1, 1e-12, 2, 1}, {2, 1e-12, 6, 2}});
  CHECK(fit.slope == Approx((2 + 12.0 / 4) / (1 + 4.0 / 4)));
  CHECK(fit.error == Approx(1 / std::sqrt(2.0)));
  CHECK(fit.chi2_per_dof == Approx(0.25 + 1.0 / 4));
}

// 1000 sets of four points with errors on both axes: the planted slope lies within one claimed
// error in 68.3 % of them, to within 1.5 %, three of which are allowed; chi2 has a mean of 1.
TEST_CASE("the planted slope lies within the claimed error as often as it must") {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  int within = 0;
  double chi2 = 0;
  for (int set = 0; set < 1000; ++set) {
    std::vector<ErrorPoint> points;
    for (const double x : {1.0, 1.5, 2.0, 3.0}) {
      points.push_back({x + 0.05 * normal(generator), 0.05, 4 * x + 0.2 * normal(generator), 0.2});
    }
    const auto fit = fit_proportionality(points);
    within += std::abs(fit.slope - 4) < fit.error ? 1 : 0;
    chi2 += fit.chi2_per_dof / 1000;
  }
  CHECK(within / 1000.0 == Approx(0.683).margin(0.045));
  CHECK(chi2 == Approx(1).margin(0.1));
}

}  // namespace
}  // namespace grainsweep
