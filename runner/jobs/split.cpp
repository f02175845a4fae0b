#include "runner/jobs/split.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

#include "runner/jobs/schedule.hpp"

namespace grainsweep {

std::vector<int> split(const std::vector<Cost>& costs, int shards) {
  using Load = std::pair<std::int64_t, int>;  // microseconds, number of the shard
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (int number = 1; number <= shards; ++number) loads.emplace(0, number);
  std::vector<Cost> whole = costs;
  for (Cost& cost : whole) cost.cpu_seconds = std::round(1e6 * cost.cpu_seconds);
  std::vector<int> shard_of(costs.size());
  for (const std::size_t index : longest_first(whole)) {
    const auto [load, number] = loads.top();
    loads.pop();
    shard_of[index] = number;
    loads.emplace(load + std::llround(whole[index].cpu_seconds), number);
  }
  return shard_of;
}

}  // namespace grainsweep
