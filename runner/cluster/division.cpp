#include "runner/cluster/division.hpp"

#include <algorithm>
#include <cmath>

#include "runner/jobs/estimates.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/jobs/split.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr double brief_shard = 600.0, long_shard = 3600.0;  // s of a shard

/// A runner takes so much of what it finds free for packings.
constexpr double share_for_packings = 0.8;

/// Of a process that holds the list of the packings of a sweep, bytes.
double bytes_of_runner(std::size_t packings) {
  return 1.5e8 + 3000.0 * static_cast<double>(packings);
}

/// For what live packings take together; 0 if memory sets no limit.
double memory_for_live(const ClusterLimits& limits, std::size_t packings) {
  if (limits.memory <= 0.0) return 0.0;
  return std::max(1.0, share_for_packings * (limits.memory - bytes_of_runner(packings)));
}

/// Of `wanted` ones, so many as there is memory for packings.
int threads_within(const ClusterLimits& limits, const std::vector<Cost>& costs, int wanted) {
  const int live = live_limit(costs, {wanted, memory_for_live(limits, costs.size())});
  return static_cast<std::size_t>(live) == costs.size() ? wanted : live;
}

/// A number of shards and what decided it.
struct Decision {
  int shards = 1;
  std::string reason;
};

int at_most(double count, std::size_t packings) {
  return static_cast<int>(
      std::clamp(count, 1.0, static_cast<double>(std::max<std::size_t>(1, packings))));
}

/// By time alone: `node_seconds` is what the sweep takes one node.
Decision by_time(double node_seconds, const ClusterLimits& limits, std::size_t packings) {
  const bool is_short = limits.seconds > 0.0 && limits.seconds / 3.0 < long_shard;
  const double most = is_short ? limits.seconds / 3.0 : long_shard;
  const double least = std::min(brief_shard, most);
  const int fewest = at_most(std::ceil(node_seconds / most), packings);
  const int greatest = std::max(fewest, at_most(std::floor(node_seconds / least), packings));
  if (limits.nodes > greatest) {
    const bool is_by_count = static_cast<std::size_t>(greatest) == packings;
    return {greatest, is_by_count ? "a shard has one packing at least"
                                  : "a shard takes " + duration_text(least) + " at least"};
  }
  if (limits.nodes >= fewest) return {limits.nodes, "the partition has so many nodes"};
  return {fewest, is_short ? "a shard takes a third of the time limit at most"
                           : "a shard takes " + duration_text(most) + " at most"};
}

Decision decide(double node_seconds, const ClusterLimits& limits, std::size_t packings, int asked) {
  Decision decision =
      asked > 0 ? Decision{asked, "it was asked for"} : by_time(node_seconds, limits, packings);
  if (limits.elements > 0 && decision.shards > limits.elements) {
    decision = {limits.elements, "an array has no more elements (MaxArraySize)"};
  }
  return decision;
}

/// Wall time of the longest shard, s.
double longest_shard(const std::vector<Cost>& costs, int shards, int threads) {
  std::vector<std::vector<Cost>> of_shard(static_cast<std::size_t>(shards));
  const std::vector<int> shard_of = split(costs, shards);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    of_shard[static_cast<std::size_t>(shard_of[i] - 1)].push_back(costs[i]);
  }
  double seconds = 0.0;
  for (const std::vector<Cost>& some : of_shard) {
    seconds = std::max(seconds, estimate_wall(some, threads));
  }
  return seconds;
}

/// Twice as much and time to begin and end, in whole ten minutes.
double time_to_ask_for(double estimated, double limit) {
  const double seconds = 600.0 * std::ceil((2.0 * estimated + 120.0) / 600.0);
  return limit > 0.0 ? std::min(seconds, limit) : seconds;
}

double memory_to_ask_for(const std::vector<Cost>& costs, int threads, double limit) {
  const double needed =
      bytes_of_runner(costs.size()) + bytes_of_largest(costs, threads) / share_for_packings;
  const double whole = 1e8 * std::ceil(needed / 1e8);
  return std::min(whole, limit);
}

}  // namespace

Division divide(const std::vector<Cost>& costs, const ClusterLimits& limits, int shards,
                int threads) {
  Division division;
  division.threads = threads_within(limits, costs, threads > 0 ? threads : limits.cores);
  const double node_seconds = total_cpu_seconds(costs) / division.threads;
  Decision decision = decide(node_seconds, limits, costs.size(), shards);
  division.shards = decision.shards;
  division.reason = std::move(decision.reason);
  division.bytes = memory_to_ask_for(costs, division.threads, limits.memory);
  division.estimated = longest_shard(costs, division.shards, division.threads);
  division.seconds = time_to_ask_for(division.estimated, limits.seconds);
  return division;
}

}  // namespace grainsweep
