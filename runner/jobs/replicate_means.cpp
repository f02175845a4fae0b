#include "runner/jobs/replicate_means.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace grainsweep {

double student_quantile(int degrees_of_freedom) {
  // By that of the normal distribution (Abramowitz and Stegun 26.7.5).
  constexpr double x = 1.959963984540054, x2 = x * x;
  constexpr double terms[] = {
      x * (x2 + 1.0) / 4.0, x * ((5.0 * x2 + 16.0) * x2 + 3.0) / 96.0,
      x * (((3.0 * x2 + 19.0) * x2 + 17.0) * x2 - 15.0) / 384.0,
      x * ((((79.0 * x2 + 776.0) * x2 + 1482.0) * x2 - 1920.0) * x2 - 945.0) / 92160.0};
  double quantile = x, power = 1.0;
  for (const double term : terms) quantile += term / (power *= degrees_of_freedom);
  return quantile;
}

double half_interval(double sd, int n) {
  if (n < 2) return std::numeric_limits<double>::infinity();
  return student_quantile(n - 1) * sd / std::sqrt(static_cast<double>(n));
}

Means means_of(const std::vector<const Outcome*>& made, int count) {
  std::vector<double> fractions, numbers;
  for (int i = 0; i < count; ++i) {
    const PackingResult& result = made[static_cast<std::size_t>(i)]->result;
    if (result.status != PackingStatus::settled || result.coordination.empty()) continue;
    fractions.push_back(result.solid_fraction);
    numbers.push_back(result.coordination.front().between_grains);
  }
  return {spread_of(fractions), spread_of(numbers)};
}

}  // namespace grainsweep
