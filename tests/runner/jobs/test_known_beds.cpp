#include <functional>

#include <catch2/catch.hpp>

#include "runner/jobs/known_beds.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/versions.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

/// A folder of packings, settled after 500 steps, that have the bed 7 in common.
class Stored {
 public:
  Outcome& add(const std::string& job) {
    Outcome outcome;
    outcome.job = job;
    outcome.version = program_version();
    outcome.bed = 7;
    outcome.result.status = PackingStatus::settled;
    outcome.result.steps = 500;
    StoredBed bed;
    bed.job = job;
    bed.grains = {{1, 1, 0.5, 0.5, 1, 0}};
    add_stored_bed(path(), bed, outcome);
    return *outcomes_.try_emplace(job, outcome).first->second;
  }
  const std::string& path() const { return folder_.path(); }
  const Outcomes& outcomes() const { return outcomes_; }
  KnownBeds known_to(const Job& pending) const { return known_beds(path(), outcomes_, {&pending}); }

 private:
  TemporaryFolder folder_;
  Outcomes outcomes_;
};

/// It settles as the bed 7, and ends as the bed 9 if it does not settle.
Job job_with_steps(int max_steps) {
  Job job;
  job.id = "it";
  job.bed = 9;
  job.settled_bed = 7;
  job.spec.accuracy.max_steps = max_steps;
  return job;
}

TEST_CASE("a bed is known if its packing is of this version, at its end and has its grains") {
  const auto is_known = [](const std::function<void(Outcome&)>& change) {
    Stored stored;
    change(stored.add("a"));
    return stored.known_to(job_with_steps(20'000)).size() == 1;
  };
  CHECK(is_known([](Outcome&) {}));
  CHECK_FALSE(is_known([](Outcome& one) { one.result.status = PackingStatus::failed; }));
  CHECK_FALSE(is_known([](Outcome& one) { one.version = "0.0.1"; }));
  CHECK_FALSE(is_known([](Outcome& one) { one.bed.reset(); }));
  CHECK_FALSE(is_known([](Outcome& one) { one.bed = 8; }));
}

TEST_CASE("a settled bed is known to a packing that has the steps for it, others to their like") {
  Stored stored;
  Outcome& outcome = stored.add("a");
  const auto known_with = [&](int max_steps) {
    return stored.known_to(job_with_steps(max_steps)).size();
  };
  CHECK(known_with(500) == 1);
  CHECK(known_with(499) == 0);
  outcome.result.status = PackingStatus::not_settled;
  CHECK(known_with(500) == 0);
  outcome.bed = 9;
  CHECK(known_with(500) == 1);
  outcome.result.status = PackingStatus::settled;
  CHECK(known_with(500) == 0);
  Job job = job_with_steps(500);
  CHECK(name_of_bed(job, outcome.result) == 7);
  outcome.result.status = PackingStatus::not_settled;
  CHECK(name_of_bed(job, outcome.result) == 9);
}

TEST_CASE("a damaged bed is not known, but one that is the same is") {
  Stored stored;
  damage_bed(stored.path(), stored.add("a"), 40);
  CHECK(stored.known_to(job_with_steps(500)).empty());
  stored.add("b");
  CHECK(stored.known_to(job_with_steps(500)).at("it")->job == "b");
}

TEST_CASE("measuring a known bed costs little") {
  Stored stored;
  stored.add("a");
  const Job packed, known = job_with_steps(20'000);
  const std::vector<const Job*> jobs = {&packed, &known};
  const auto costs = costs_with(stored.known_to(known), jobs), whole = costs_of(jobs);
  CHECK(costs[0].cpu_seconds == whole[0].cpu_seconds);
  CHECK(costs[1].cpu_seconds == whole[1].cpu_seconds * share_of_measuring);
  CHECK(costs[1].bytes == whole[1].bytes);
}

TEST_CASE("a bed that is damaged after it was found is not measured") {
  Stored stored;
  const Outcome outcome = stored.add("a");
  const Job job = job_with_steps(500);
  const KnownBeds beds = stored.known_to(job);
  REQUIRE(beds.size() == 1);
  damage_bed(stored.path(), outcome, 40);
  CHECK_FALSE(measured_from(beds, stored.path(), job, kernels_for(Isa::sse2)));
}

}  // namespace
}  // namespace grainsweep
