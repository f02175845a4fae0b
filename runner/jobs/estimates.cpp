#include "runner/jobs/estimates.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

namespace grainsweep {

double total_cpu_seconds(const std::vector<Cost>& costs) {
  return std::accumulate(costs.begin(), costs.end(), 0.0,
                         [](double sum, const Cost& cost) { return sum + cost.cpu_seconds; });
}

double bytes_of_largest(const std::vector<Cost>& costs, int live) {
  std::vector<double> bytes;
  bytes.reserve(costs.size());
  for (const Cost& cost : costs) bytes.push_back(cost.bytes);
  std::sort(bytes.begin(), bytes.end(), std::greater<>());
  bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(live)));
  return std::accumulate(bytes.begin(), bytes.end(), 0.0);
}

void LearnedEstimates::add(double estimated, double measured) {
  for (Sums* sums : {&of_all_, &of_estimate_[estimated]}) {
    sums->measured += measured;
    sums->estimated += estimated;
  }
}

double LearnedEstimates::of(double estimated) const {
  const auto same = of_estimate_.find(estimated);
  const Sums& teacher = same == of_estimate_.end() ? of_all_ : same->second;
  return estimated * teacher.ratio();
}

std::vector<double> learned(const std::vector<Known>& packings) {
  LearnedEstimates estimates;
  for (const Known& packing : packings) {
    if (packing.measured) estimates.add(packing.estimated, *packing.measured);
  }
  std::vector<double> better;
  better.reserve(packings.size());
  for (const Known& packing : packings) better.push_back(estimates.of(packing.estimated));
  return better;
}

}  // namespace grainsweep
