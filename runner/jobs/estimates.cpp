#include "runner/jobs/estimates.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <unordered_map>

namespace grainsweep {

std::vector<Cost> costs_of(const std::vector<const Job*>& jobs) {
  std::vector<Cost> costs;
  costs.reserve(jobs.size());
  for (const Job* job : jobs) costs.push_back(estimate_cost(job->spec));
  return costs;
}

std::vector<Cost> costs_of(const std::vector<Job>& jobs) {
  std::vector<Cost> costs;
  costs.reserve(jobs.size());
  for (const Job& job : jobs) costs.push_back(estimate_cost(job.spec));
  return costs;
}

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

namespace {

/// What packings that are made took together, and what was estimated.
struct Sums {
  double measured = 0.0, estimated = 0.0;

  void add(const Known& packing) {
    measured += *packing.measured;
    estimated += packing.estimated;
  }
  double ratio() const { return estimated > 0.0 ? measured / estimated : 1.0; }
};

}  // namespace

std::vector<double> learned(const std::vector<Known>& packings) {
  std::unordered_map<double, Sums> of_estimate;
  Sums of_all;
  for (const Known& packing : packings) {
    if (!packing.measured) continue;
    of_all.add(packing);
    of_estimate[packing.estimated].add(packing);
  }
  std::vector<double> better;
  better.reserve(packings.size());
  for (const Known& packing : packings) {
    const auto same = of_estimate.find(packing.estimated);
    const Sums& teacher = same == of_estimate.end() ? of_all : same->second;
    better.push_back(packing.estimated * teacher.ratio());
  }
  return better;
}

}  // namespace grainsweep
