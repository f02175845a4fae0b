#include "runner/jobs/sweep_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

#include "runner/jobs/growing_families.hpp"
#include "runner/jobs/replicate_means.hpp"
#include "runner/jobs/split.hpp"
#include "runner/sweep/costs.hpp"

namespace grainsweep {
namespace {

/// Jobs that belong to one shard.
struct Part {
  std::vector<Places> jobs;
  Cost cost;
};

/// Adds a group to a part, with what it takes at first.
void add_group(const Sweep& whole, const Places& group, const std::vector<Cost>& costs,
               Part& part) {
  const Cost& one = costs[group.front()];
  const std::size_t count = may_grow(whole.jobs[group.front()])
                                ? static_cast<std::size_t>(first_replicates)
                                : group.size();
  part.jobs.push_back(group);
  part.cost.cpu_seconds += one.cpu_seconds * static_cast<double>(count);
  part.cost.bytes = std::max(part.cost.bytes, one.bytes);
}

std::vector<Part> parts_of(const Sweep& whole, const std::vector<Cost>& costs) {
  const std::vector<Places> groups = groups_in(whole);
  std::vector<Part> parts;
  std::set<std::size_t> of_families;
  for (const GrowingFamily& family : growing_families(whole, groups)) {
    parts.emplace_back();
    for (const std::size_t k : family.groups) add_group(whole, groups[k], costs, parts.back());
    of_families.insert(family.groups.begin(), family.groups.end());
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (of_families.contains(k)) continue;
    if (may_grow(whole.jobs[groups[k].front()])) {
      add_group(whole, groups[k], costs, parts.emplace_back());
      continue;
    }
    for (const std::size_t i : groups[k]) parts.push_back({{{i}}, costs[i]});
  }
  return parts;
}

}  // namespace

std::vector<int> shards_of(const Sweep& whole, int shards) {
  const std::vector<Cost> costs = costs_of(whole.jobs);
  if (!grows(whole)) return split(costs, shards);
  const std::vector<Part> parts = parts_of(whole, costs);
  std::vector<Cost> of_parts;
  of_parts.reserve(parts.size());
  for (const Part& part : parts) of_parts.push_back(part.cost);
  const std::vector<int> shard_of_part = split(of_parts, shards);
  std::vector<int> shard_of(whole.jobs.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const Places& group : parts[k].jobs) {
      for (const std::size_t i : group) shard_of[i] = shard_of_part[k];
    }
  }
  return shard_of;
}

}  // namespace grainsweep
