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

TEST_CASE("a part has the jobs that are made at first, and those that it may grow by") {
  Sweep whole{"s", 7, 1, growing_group("g", 4.0, 10, {0.01, 0.0})};
  for (const Job& job : growing_group("h", 5.0, 2, {})) whole.jobs.push_back(job);
  const std::vector<Part> parts = parts_of(whole, std::vector<Cost>(12, Cost{60.0, 1e7}));
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].first == Places{0, 1, 2, 3, 4, 5});
  CHECK(parts[0].later == Places{6, 7, 8, 9});
  CHECK(parts[0].cost.cpu_seconds == 360.0);
  CHECK(parts[2].first == Places{11});
}

TEST_CASE("a family whose fit grows belongs to one shard") {
  Sweep whole{"s", 7, 1, {}};
  for (const char* const name : {"a", "b", "c"}) {
    const Sweep one = fit_sweep(10, {0.005, 0, 0, 0}, name);
    whole.jobs.insert(whole.jobs.end(), one.jobs.begin(), one.jobs.end());
  }
  CHECK(parts_of(whole, std::vector<Cost>(whole.jobs.size(), Cost{60.0, 1e7})).size() == 3);
  const std::vector<int> shard_of = shards_of(whole, 3);
  const std::size_t of_family = 3 * 10 + first_replicates;
  REQUIRE(shard_of.size() == 3 * of_family);
  for (std::size_t i = 0; i < shard_of.size(); ++i) {
    CHECK(shard_of[i] == shard_of[i / of_family * of_family]);
  }
  CHECK(std::set<int>(shard_of.begin(), shard_of.end()).size() == 3);
}

}  // namespace
}  // namespace grainsweep
