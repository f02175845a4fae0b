#include <catch2/catch.hpp>

#include "runner/sweep/costs.hpp"

namespace grainsweep {
namespace {

TEST_CASE("the costs of jobs stand in their order, however they are listed") {
  std::vector<Job> jobs(3);
  jobs[1].parameters = "tall";
  jobs[1].spec.fill = SolidHeight{100.0};
  const std::vector<Cost> costs = costs_of(jobs);
  REQUIRE(costs.size() == 3);
  CHECK(costs[0].cpu_seconds == estimate_cost(jobs[0].spec).cpu_seconds);
  CHECK(costs[1].cpu_seconds == estimate_cost(jobs[1].spec).cpu_seconds);
  CHECK(costs[2].cpu_seconds == costs[0].cpu_seconds);
  const std::vector<const Job*> backwards = {&jobs[1], &jobs[0]};
  CHECK(costs_of(backwards)[0].cpu_seconds == costs[1].cpu_seconds);
  CHECK(costs_of(backwards)[1].bytes == costs[0].bytes);
  CHECK(costs_of(std::vector<Job>{}).empty());
}

TEST_CASE("jobs that start from positions of their own have costs of their own") {
  std::vector<Job> jobs(2);
  jobs[0].spec.fill = PlacedGrains{std::vector<PlacedSphere>(10)};
  jobs[1].spec.fill = PlacedGrains{std::vector<PlacedSphere>(30)};
  const std::vector<Cost> costs = costs_of(jobs);
  CHECK(costs[0].cpu_seconds < costs[1].cpu_seconds);
}

}  // namespace
}  // namespace grainsweep
