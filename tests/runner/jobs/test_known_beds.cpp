#include <functional>

#include <catch2/catch.hpp>

#include "runner/jobs/known_beds.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

Outcomes stored_with(const std::function<void(Outcome&)>& change) {
  Outcome outcome;
  outcome.job = "a";
  outcome.version = program_version();
  outcome.bed = 7;
  outcome.result.status = PackingStatus::settled;
  change(outcome);
  Outcomes stored;
  stored.try_emplace("a", outcome);
  return stored;
}

TEST_CASE("a bed is known if its packing is of this version, at its end and has its grains") {
  Job pending;
  pending.bed = 7;
  const auto known = [&](const std::function<void(Outcome&)>& change) {
    return known_beds(stored_with(change), {&pending}).size();
  };
  CHECK(known([](Outcome&) {}) == 1);
  CHECK(known([](Outcome& one) { one.result.status = PackingStatus::not_settled; }) == 1);
  CHECK(known([](Outcome& one) { one.result.status = PackingStatus::failed; }) == 0);
  CHECK(known([](Outcome& one) { one.version = "0.0.1"; }) == 0);
  CHECK(known([](Outcome& one) { one.bed.reset(); }) == 0);
  CHECK(known([](Outcome& one) { one.bed = 8; }) == 0);
}

TEST_CASE("measuring a known bed costs little") {
  Job packed, known;
  known.bed = 7;
  const std::vector<const Job*> jobs = {&packed, &known};
  const auto beds = known_beds(stored_with([](Outcome&) {}), jobs);
  const auto costs = costs_with(beds, jobs), whole = costs_of(jobs);
  CHECK(costs[0].cpu_seconds == whole[0].cpu_seconds);
  CHECK(costs[1].cpu_seconds == whole[1].cpu_seconds * share_of_measuring);
  CHECK(costs[1].bytes == whole[1].bytes);
}

TEST_CASE("of a bed that is not sound nothing is measured") {
  Job job;
  job.bed = 7;
  const auto beds = known_beds(stored_with([](Outcome& one) { one.stored_bytes = 9; }), {&job});
  REQUIRE(beds.size() == 1);
  CHECK_FALSE(measured_from(beds, "no such folder", job, kernels_for(Isa::sse2)));
}

}  // namespace
}  // namespace grainsweep
