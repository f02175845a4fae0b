#include "runner/jobs/sweep_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

#include "runner/jobs/growing_families.hpp"
#include "runner/jobs/split.hpp"
#include "runner/sweep/costs.hpp"

namespace grainsweep {
namespace {

/// Adds a group to a part.
void add_group(const Sweep& whole, const Places& group, const std::vector<Cost>& costs,
               Part& part) {
  const Cost& one = costs[group.front()];
  const bool grows = may_grow(whole.jobs[group.front()]);
  const std::size_t count =
      grows ? std::min<std::size_t>(first_replicates, group.size()) : group.size();
  const auto end = group.begin() + static_cast<std::ptrdiff_t>(count);
  part.first.insert(part.first.end(), group.begin(), end);
  part.later.insert(part.later.end(), end, group.end());
  part.cost.cpu_seconds += one.cpu_seconds * static_cast<double>(count);
  part.cost.bytes = std::max(part.cost.bytes, one.bytes);
}

}  // namespace

std::vector<Part> parts_of(const Sweep& whole, const std::vector<Cost>& costs) {
  std::vector<Part> parts;
  if (!grows(whole)) {
    for (std::size_t i = 0; i < costs.size(); ++i) parts.push_back({{i}, {}, costs[i]});
    return parts;
  }
  const std::vector<Places> groups = groups_in(whole);
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
    for (const std::size_t i : groups[k]) parts.push_back({{i}, {}, costs[i]});
  }
  return parts;
}

std::vector<int> shards_of(const std::vector<Part>& parts, int shards) {
  std::vector<Cost> of_parts;
  of_parts.reserve(parts.size());
  for (const Part& part : parts) of_parts.push_back(part.cost);
  return split(of_parts, shards);
}

std::vector<int> shards_of(const Sweep& whole, int shards) {
  const std::vector<Cost> costs = costs_of(whole.jobs);
  if (!grows(whole)) return split(costs, shards);
  const std::vector<Part> parts = parts_of(whole, costs);
  const std::vector<int> shard_of_part = shards_of(parts, shards);
  std::vector<int> shard_of(whole.jobs.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const std::size_t i : parts[k].first) shard_of[i] = shard_of_part[k];
    for (const std::size_t i : parts[k].later) shard_of[i] = shard_of_part[k];
  }
  return shard_of;
}

}  // namespace grainsweep
