#include "runner/sweep/costs.hpp"

#include <string_view>
#include <unordered_map>
#include <variant>

namespace grainsweep {
namespace {

class Estimates {
 public:
  Cost of(const Job& job) {
    if (std::holds_alternative<PlacedGrains>(job.spec.fill)) return estimate_cost(job.spec);
    const auto [known, is_new] = known_.try_emplace(job.parameters);
    if (is_new) known->second = estimate_cost(job.spec);
    return known->second;
  }

 private:
  std::unordered_map<std::string_view, Cost> known_;  ///< by parameters
};

}  // namespace

std::vector<Cost> costs_of(const std::vector<const Job*>& jobs) {
  Estimates estimates;
  std::vector<Cost> costs;
  costs.reserve(jobs.size());
  for (const Job* job : jobs) costs.push_back(estimates.of(*job));
  return costs;
}

std::vector<Cost> costs_of(const std::vector<Job>& jobs) {
  Estimates estimates;
  std::vector<Cost> costs;
  costs.reserve(jobs.size());
  for (const Job& job : jobs) costs.push_back(estimates.of(job));
  return costs;
}

}  // namespace grainsweep
