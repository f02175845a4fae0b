#include <set>

#include <catch2/catch.hpp>

#include "runner/jobs/sweep_parts.hpp"
#include "tests/runner/jobs/growing_sweeps.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a growing group belongs to one shard") {
  Sweep whole{"s", 7, 1, {}};
  for (int group = 0; group < 8; ++group) {
    const auto jobs = growing_group("g" + std::to_string(group), 4.0 + group, 10, {0.01, 0.0});
    whole.jobs.insert(whole.jobs.end(), jobs.begin(), jobs.end());
  }
  const std::vector<int> shard_of = shards_of(whole, 3);
  REQUIRE(shard_of.size() == whole.jobs.size());
  for (std::size_t i = 0; i < shard_of.size(); ++i) CHECK(shard_of[i] == shard_of[i / 10 * 10]);
  CHECK(std::set<int>(shard_of.begin(), shard_of.end()).size() == 3);
}

TEST_CASE("a family whose fit grows belongs to one shard") {
  Sweep whole{"s", 7, 1, {}};
  for (const char* const name : {"a", "b", "c"}) {
    const Sweep one = fit_sweep(10, {0.005, 0, 0, 0}, name);
    whole.jobs.insert(whole.jobs.end(), one.jobs.begin(), one.jobs.end());
  }
  const std::vector<int> shard_of = shards_of(whole, 3);
  REQUIRE(shard_of.size() == 120);
  for (std::size_t i = 0; i < shard_of.size(); ++i) CHECK(shard_of[i] == shard_of[i / 40 * 40]);
  CHECK(std::set<int>(shard_of.begin(), shard_of.end()).size() == 3);
}

}  // namespace
}  // namespace grainsweep
