#include "runner/jobs/replicate_means.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "runner/analysis/student.hpp"

namespace grainsweep {

double half_interval(double sd, int n) {
  if (n < 2) return std::numeric_limits<double>::infinity();
  return student_quantile(n - 1) * sd / std::sqrt(static_cast<double>(n));
}

Means means_of(const std::vector<const Outcome*>& made, int count) {
  std::vector<double> fractions, numbers, heights, grains;
  for (int i = 0; i < count; ++i) {
    const PackingResult& result = made[static_cast<std::size_t>(i)]->result;
    if (result.status != PackingStatus::settled || result.coordination.empty()) continue;
    fractions.push_back(result.solid_fraction);
    numbers.push_back(result.coordination.front().between_grains);
    heights.push_back(slab_height(result));
    grains.push_back(static_cast<double>(result.grains));
  }
  return {spread_of(fractions), spread_of(numbers), spread_of(heights), spread_of(grains)};
}

}  // namespace grainsweep
