#include <cmath>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/analysis/student.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

/// Probability between -t and t, by its finite series of cosines (Abramowitz and Stegun 26.7.3 and
/// 26.7.4).
double probability_within(double t, int degrees) {
  const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
  const double cosine2 = std::cos(angle) * std::cos(angle);
  const bool is_odd = degrees % 2 == 1;
  double term = is_odd ? std::cos(angle) : 1.0, sum = 0.0;
  for (int k = is_odd ? 1 : 0; k <= degrees - 2; k += 2) {
    sum += term;
    term *= cosine2 * (k + 1.0) / (k + 2.0);
  }
  return is_odd ? 2.0 / pi * (angle + std::sin(angle) * sum) : std::sin(angle) * sum;
}

TEST_CASE("95 % lie within Student's quantile, however few degrees of freedom there are") {
  for (int degrees = 1; degrees <= 200; ++degrees) {
    INFO(degrees << " degrees of freedom");
    // An error of 1e-5 in the quantile is one of 2e-6 in the probability at most.
    CHECK(probability_within(student_quantile(degrees), degrees) == about(0.95, 2e-6));
  }
  CHECK(student_quantile(1) == about(12.7062, 1e-4));  // of printed tables
  CHECK(student_quantile(2) == about(4.30265, 1e-5));
  CHECK(student_quantile(1000000000) == about(normal_quantile, 1e-8));
}

}  // namespace
}  // namespace grainsweep
