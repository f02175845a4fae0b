#include <algorithm>
#include <optional>
#include <set>

#include <catch2/catch.hpp>

#include "runner/jobs/helping.hpp"
#include "runner/jobs/sweep_parts.hpp"
#include "runner/machine.hpp"
#include "runner/store/shard_files.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

using Places = std::vector<std::size_t>;

std::vector<Cost> costs(const std::vector<double>& seconds) {
  std::vector<Cost> costs;
  for (const double one : seconds) costs.push_back({one, 0});
  return costs;
}

TEST_CASE("half of what the busiest shard has not begun is taken over, from its end") {
  const std::vector<Cost> all = costs({5, 4, 3, 2, 1, 9, 1, 1});
  CHECK(jobs_to_take_over({{1, {0, 1, 2, 3, 4}}, {1, {5, 6}}}, all) == Places{3, 4});
  CHECK(jobs_to_take_over({{1, {0, 4}}, {0, {5}}}, all) == Places{5});
  CHECK(jobs_to_take_over({{0, {0, 1, 2}}}, all) == Places{1, 2});
  CHECK(jobs_to_take_over({{-1, {3}}}, all) == Places{3});
}

TEST_CASE("nothing is taken from a shard that has begun all") {
  const std::vector<Cost> all = costs({5, 4, 3});
  CHECK(jobs_to_take_over({}, all).empty());
  CHECK(jobs_to_take_over({{1, {0}}, {4, {1, 2}}, {1, {}}}, all).empty());
}

/// A sweep of twelve equal packings in a folder of two shards, of which this process makes one.
class TwoShards {
 public:
  TwoShards() {
    for (int k = 0; k < 12; ++k) {
      Job job;
      job.id = std::string(15, '0') + "0123456789ab"[k];
      job.replicate = k + 1;
      job.parameters = "{}";
      sweep_.jobs.push_back(job);
    }
    const std::vector<int> shard_of = shards_of(sweep_, 2);
    for (std::size_t k = 0; k < shard_of.size(); ++k) {
      if (shard_of[k] == 2) others_.push_back(sweep_.jobs[k].id);
    }
  }

  const Sweep& sweep() const { return sweep_; }
  const std::string& path() const { return folder_.path(); }
  /// Those of the other shard, in the order in which its runner takes them.
  const std::vector<std::string>& others() const { return others_; }

  void begin_other(const std::string& host, int threads, const Shard& shard = {2, 2}) {
    RunRecord run = sample_run();
    run.ended.clear();
    run.host = host;
    run.process = process();
    run.threads = threads;
    files_.emplace(folder_.path(), shard, run);
  }
  void finish(const std::string& job) {
    Outcome outcome;
    outcome.job = job;
    files_->add(outcome);
    files_->flush();
  }
  void end_other() { files_.reset(); }
  static std::string process() { return host_name() + "-1-999999999"; }  // has ended

  std::vector<std::string> next() const {
    std::vector<std::string> ids;
    for (const Job* job : Helping(sweep_, {1, 2}, path()).next().jobs) ids.push_back(job->id);
    return ids;
  }

 private:
  TemporaryFolder folder_;
  Sweep sweep_;
  std::vector<std::string> others_;
  std::optional<ShardFiles> files_;
};

TEST_CASE(
    "a runner takes over what another one at work has neither made nor begun, piece by piece") {
  TwoShards folder;
  REQUIRE(folder.others().size() == 6);
  folder.begin_other(host_name(), 2);
  folder.finish(folder.others()[0]);
  // One is made, two may be under way.
  CHECK(folder.next() == std::vector(folder.others().begin() + 4, folder.others().end()));
  CHECK(folder.next() == std::vector(folder.others().begin() + 3, folder.others().begin() + 4));
  CHECK(folder.next().empty());
}

TEST_CASE("what a runner has claimed is known to be under way") {
  TwoShards folder;
  folder.begin_other(host_name(), 1);
  open_claims(folder.path());
  Claims(folder.path(), TwoShards::process(), {}).take({folder.others()[0]});
  CHECK(folder.next().size() == 3);
  CHECK(folder.next().size() == 1);
  CHECK(folder.next().size() == 1);
  CHECK(folder.next().empty());
}

TEST_CASE("nothing is taken over from shards where nobody works") {
  TwoShards folder;
  folder.begin_other(host_name(), 1);
  folder.end_other();
  CHECK(folder.next().empty());
}

TEST_CASE("nothing is taken over from a runner that divides the sweep otherwise") {
  TwoShards folder;
  folder.begin_other(host_name(), 1, {1, 3});
  CHECK(folder.next().empty());
}

TEST_CASE("what a runner had claimed that is gone is made by the next one") {
  TwoShards folder;
  folder.begin_other(host_name(), 1);
  Claims(folder.path(), "gone-9", {}).take({folder.others()[1], folder.others()[2]});
  folder.finish(folder.others()[2]);
  CHECK(folder.next() == std::vector{folder.others()[1]});
}

}  // namespace
}  // namespace grainsweep
