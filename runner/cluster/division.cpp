#include "runner/cluster/division.hpp"

#include <algorithm>
#include <cmath>

#include "runner/jobs/estimates.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/machine.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr double brief_shard = 600.0, long_shard = 3600.0;  // s of a shard

/// Memory of a process that holds the list of the packings of a sweep, bytes.
double bytes_of_runner(std::size_t packings) {
  return 1.5e8 + 3000.0 * static_cast<double>(packings);
}

/// Memory for what live packings take together; infinite if memory sets no limit.
double memory_for_live(const ClusterLimits& limits, std::size_t packings) {
  return share_for_packings * (limits.memory - bytes_of_runner(packings));
}

/// The `wanted` number, or as many as there is memory for packings.
int threads_within(const ClusterLimits& limits, const std::vector<Cost>& costs, int wanted) {
  const int live = live_limit(costs, {wanted, memory_for_live(limits, costs.size())});
  return static_cast<std::size_t>(live) == costs.size() ? wanted : live;
}

/// A number of shards and what decided it.
struct Decision {
  int shards = 1;
  std::string reason;
};

int at_most(double count, std::size_t parts) {
  return static_cast<int>(
      std::clamp(count, 1.0, static_cast<double>(std::max<std::size_t>(1, parts))));
}

/// As many shards as there are parts.
Decision by_count(const std::vector<Part>& parts) {
  const bool is_divided = std::all_of(parts.begin(), parts.end(), [](const Part& part) {
    return part.first.size() + part.later.size() == 1;
  });
  return {at_most(static_cast<double>(parts.size()), parts.size()),
          is_divided ? "a shard has one packing at least"
                     : "a shard has one packing at least, and growing groups and families whole"};
}

/// By time only: `node_seconds` is what the sweep takes on one node.
Decision by_time(double node_seconds, const ClusterLimits& limits, const std::vector<Part>& parts) {
  const bool is_short = limits.seconds > 0.0 && limits.seconds / 3.0 < long_shard;
  const double most = is_short ? limits.seconds / 3.0 : long_shard;
  const double least = std::min(brief_shard, most);
  const int fewest = at_most(std::ceil(node_seconds / most), parts.size());
  const int greatest = std::max(fewest, at_most(std::floor(node_seconds / least), parts.size()));
  const bool is_by_count = static_cast<std::size_t>(greatest) == parts.size();
  if (limits.nodes > greatest) {
    if (is_by_count) return by_count(parts);
    return {greatest, "a shard takes " + duration_text(least) + " at least"};
  }
  if (limits.nodes >= fewest) return {limits.nodes, "the partition has so many nodes"};
  if (node_seconds / most > static_cast<double>(parts.size())) return by_count(parts);
  return {fewest, is_short ? "a shard takes a third of the time limit at most"
                           : "a shard takes " + duration_text(most) + " at most"};
}

Decision decide(double node_seconds, const ClusterLimits& limits, const std::vector<Part>& parts,
                int asked) {
  Decision decision =
      asked > 0 ? Decision{asked, "it was asked for"} : by_time(node_seconds, limits, parts);
  if (static_cast<std::size_t>(decision.shards) > parts.size()) decision = by_count(parts);
  if (limits.elements > 0 && decision.shards > limits.elements) {
    decision = {limits.elements, "an array has no more elements (MaxArraySize)"};
  }
  return decision;
}

void append(const Places& jobs, const std::vector<Cost>& costs, std::vector<Cost>& some) {
  for (const std::size_t i : jobs) some.push_back(costs[i]);
}

/// Wall time of the longest shard at first, or when all has grown to the most, s.
double longest_shard(const std::vector<Part>& parts, const std::vector<Cost>& costs,
                     const Division& division, bool is_grown) {
  std::vector<std::vector<Cost>> of_shard(static_cast<std::size_t>(division.shards));
  const std::vector<int> shard_of = shards_of(parts, division.shards);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::vector<Cost>& some = of_shard[static_cast<std::size_t>(shard_of[k] - 1)];
    append(parts[k].first, costs, some);
    if (is_grown) append(parts[k].later, costs, some);
  }
  double seconds = 0.0;
  for (const std::vector<Cost>& some : of_shard) {
    seconds = std::max(seconds, estimate_wall(some, division.threads));
  }
  return seconds;
}

/// Includes time to begin and end, in whole ten minutes.
double time_to_ask_for(double needed, double limit) {
  const double seconds = 600.0 * std::ceil((needed + 120.0) / 600.0);
  return limit > 0.0 ? std::min(seconds, limit) : seconds;
}

/// Time of a node with so many threads, for the packings that are made at first.
double node_seconds_of(const std::vector<Part>& parts, int threads) {
  double seconds = 0.0;
  for (const Part& part : parts) seconds += part.cost.cpu_seconds;
  return seconds / threads;
}

double memory_to_ask_for(const std::vector<Cost>& costs, int threads, double limit) {
  if (!std::isfinite(limit)) return 0.0;
  const double needed =
      bytes_of_runner(costs.size()) + bytes_of_largest(costs, threads) / share_for_packings;
  const double whole = 1e8 * std::ceil(needed / 1e8);
  return std::min(whole, limit);
}

}  // namespace

Division divide(const std::vector<Part>& parts, const std::vector<Cost>& costs,
                const ClusterLimits& limits, int shards, int threads) {
  Division division;
  division.threads = threads_within(limits, costs, threads > 0 ? threads : limits.cores);
  Decision decision = decide(node_seconds_of(parts, division.threads), limits, parts, shards);
  division.shards = decision.shards;
  division.reason = std::move(decision.reason);
  division.bytes = memory_to_ask_for(costs, division.threads, limits.memory);
  division.estimated = longest_shard(parts, costs, division, false);
  division.grown = longest_shard(parts, costs, division, true);
  division.seconds =
      time_to_ask_for(std::max(2.0 * division.estimated, division.grown), limits.seconds);
  return division;
}

}  // namespace grainsweep
