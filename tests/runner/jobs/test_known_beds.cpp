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

/// A folder of packings that have the bed 7 in common.
class Stored {
 public:
  Outcome& add(const std::string& job) {
    Outcome outcome;
    outcome.job = job;
    outcome.version = program_version();
    outcome.bed = 7;
    outcome.result.status = PackingStatus::settled;
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

Job job_of_bed(std::uint64_t bed) {
  Job job;
  job.bed = bed;
  return job;
}

TEST_CASE("a bed is known if its packing is of this version, at its end and has its grains") {
  const auto is_known = [](const std::function<void(Outcome&)>& change) {
    Stored stored;
    change(stored.add("a"));
    return stored.known_to(job_of_bed(7)).size() == 1;
  };
  CHECK(is_known([](Outcome&) {}));
  CHECK(is_known([](Outcome& one) { one.result.status = PackingStatus::not_settled; }));
  CHECK_FALSE(is_known([](Outcome& one) { one.result.status = PackingStatus::failed; }));
  CHECK_FALSE(is_known([](Outcome& one) { one.version = "0.0.1"; }));
  CHECK_FALSE(is_known([](Outcome& one) { one.bed.reset(); }));
  CHECK_FALSE(is_known([](Outcome& one) { one.bed = 8; }));
}

TEST_CASE("a damaged bed is not known, but one that is the same is") {
  Stored stored;
  damage_bed(stored.path(), stored.add("a"), 40);
  CHECK(stored.known_to(job_of_bed(7)).empty());
  stored.add("b");
  CHECK(stored.known_to(job_of_bed(7)).at(7).job == "b");
}

TEST_CASE("measuring a known bed costs little") {
  Stored stored;
  stored.add("a");
  const Job packed, known = job_of_bed(7);
  const std::vector<const Job*> jobs = {&packed, &known};
  const auto costs = costs_with(stored.known_to(known), jobs), whole = costs_of(jobs);
  CHECK(costs[0].cpu_seconds == whole[0].cpu_seconds);
  CHECK(costs[1].cpu_seconds == whole[1].cpu_seconds * share_of_measuring);
  CHECK(costs[1].bytes == whole[1].bytes);
}

TEST_CASE("a bed that is damaged after it was found is not measured") {
  Stored stored;
  const Outcome outcome = stored.add("a");
  const Job job = job_of_bed(7);
  const KnownBeds beds = stored.known_to(job);
  REQUIRE(beds.size() == 1);
  damage_bed(stored.path(), outcome, 40);
  CHECK_FALSE(measured_from(beds, stored.path(), job, kernels_for(Isa::sse2)));
}

}  // namespace
}  // namespace grainsweep
