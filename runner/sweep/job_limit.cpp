#include "runner/sweep/job_limit.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

std::uint64_t job_count(const Block& block) {
  const std::uint64_t points = point_count(block);
  const auto replicates = static_cast<std::uint64_t>(block.replicates.most);
  return points > UINT64_MAX / replicates ? UINT64_MAX : points * replicates;
}

std::string count_text(std::uint64_t jobs) {
  return jobs == UINT64_MAX ? "more than 10^19" : in_thousands(jobs);
}

/// What makes a block large, longest first: "box.width (1,000 values), 3 replicates".
std::string factors_of(const Block& block) {
  std::vector<std::pair<std::uint64_t, std::string>> factors;
  for (const Axis& axis : block.axes) {
    if (axis.size() > 1) factors.emplace_back(axis.size(), axis.name);
  }
  if (!block.random.empty()) factors.emplace_back(block.random_count, "random");
  std::stable_sort(factors.begin(), factors.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (const auto& [count, name] : factors) text += name + " (" + in_thousands(count) + "), ";
  const auto replicates = static_cast<std::uint64_t>(block.replicates.most);
  if (replicates > 1) return text + "replicates (" + in_thousands(replicates) + ")";
  return text.substr(0, text.size() - 2);  // without the last comma
}

}  // namespace

bool fits(const SweepDefinition& definition, Diagnostics& diagnostics) {
  std::uint64_t total = 0;
  const std::size_t before = diagnostics.size();
  const std::string limit = ", more than the " + in_thousands(most_jobs) + " that a sweep may have";
  for (const Block& block : definition.blocks) {
    const std::uint64_t jobs = job_count(block);
    total = jobs > UINT64_MAX - total ? UINT64_MAX : total + jobs;
    if (jobs <= most_jobs) continue;
    diagnostics.push_back({block.pointer, "asks for " + count_text(jobs) + " jobs" + limit +
                                              "; shorten " + factors_of(block)});
  }
  if (diagnostics.size() == before && total > most_jobs) {
    diagnostics.push_back({"/sweep", "the blocks ask together for " + count_text(total) + " jobs" +
                                         limit + "; split the file"});
  }
  return diagnostics.size() == before;
}

}  // namespace grainsweep
