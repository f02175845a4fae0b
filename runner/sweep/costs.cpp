#include "runner/sweep/costs.hpp"

#include <string_view>
#include <unordered_map>
#include <variant>

namespace grainsweep {

std::vector<Cost> costs_of(const std::vector<const Job*>& jobs) {
  std::unordered_map<std::string_view, Cost> known;  // by parameters
  const auto cost_of = [&](const Job& job) {
    if (std::holds_alternative<PlacedGrains>(job.spec.fill)) return estimate_cost(job.spec);
    const auto [same, is_new] = known.try_emplace(job.parameters.text());
    if (is_new) same->second = estimate_cost(job.spec);
    return same->second;
  };
  std::vector<Cost> costs;
  costs.reserve(jobs.size());
  for (const Job* job : jobs) costs.push_back(cost_of(*job));
  return costs;
}

std::vector<Cost> costs_of(const std::vector<Job>& jobs) {
  std::vector<const Job*> all;
  all.reserve(jobs.size());
  for (const Job& job : jobs) all.push_back(&job);
  return costs_of(all);
}

}  // namespace grainsweep
