#include <algorithm>
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "runner/jobs/split.hpp"

namespace grainsweep {
namespace {

/// Costs of a mixed sweep, from 0.1 to 100 s.
std::vector<Cost> mixed_costs(int count) {
  std::vector<Cost> costs;
  for (int i = 0; i < count; ++i)
    costs.push_back({0.1 * std::pow(1000.0, (i * 37 % count) / (count - 1.0)), 0});
  return costs;
}

std::vector<double> loads_of(const std::vector<Cost>& costs, int shards) {
  std::vector<double> loads(static_cast<std::size_t>(shards));
  const std::vector<int> shard_of = split(costs, shards);
  for (std::size_t i = 0; i < costs.size(); ++i)
    loads.at(static_cast<std::size_t>(shard_of[i] - 1)) += costs[i].cpu_seconds;
  return loads;
}

TEST_CASE("every packing is in one shard, and a shard of one has all") {
  const std::vector<Cost> costs = mixed_costs(300);
  CHECK(split(costs, 1) == std::vector<int>(300, 1));
  for (const int shards : {2, 7, 64}) {
    const std::vector<int> shard_of = split(costs, shards);
    CHECK(*std::min_element(shard_of.begin(), shard_of.end()) == 1);
    CHECK(*std::max_element(shard_of.begin(), shard_of.end()) == shards);
  }
  CHECK(split({}, 3).empty());
}

// Longest first leaves no more than the last packing of the fullest shard above the mean.
TEST_CASE("shards cost the same to a tenth") {
  for (const int shards : {2, 7, 32}) {
    const std::vector<double> loads = loads_of(mixed_costs(300), shards);
    const double mean = std::accumulate(loads.begin(), loads.end(), 0.0) / shards;
    CHECK(*std::max_element(loads.begin(), loads.end()) <= 1.1 * mean);
    CHECK(*std::min_element(loads.begin(), loads.end()) >= 0.9 * mean);
  }
}

// Another library of mathematics may round a cost otherwise.
TEST_CASE("the last bits of costs do not change the shards") {
  std::vector<Cost> costs = mixed_costs(300);
  for (std::size_t i = 0; i < costs.size(); i += 2) costs[i].cpu_seconds = costs[i + 1].cpu_seconds;
  std::vector<Cost> rounded_otherwise = costs;
  for (std::size_t i = 0; i < costs.size(); i += 3) {
    rounded_otherwise[i].cpu_seconds = std::nextafter(costs[i].cpu_seconds, 1000.0);
  }
  for (const int shards : {2, 7, 64})
    CHECK(split(costs, shards) == split(rounded_otherwise, shards));
}

}  // namespace
}  // namespace grainsweep
