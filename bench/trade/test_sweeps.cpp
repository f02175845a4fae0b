#include <set>

#include <catch2/catch.hpp>

#include "runner/sweep/read_sweep.hpp"
#include "runner/tables/job_facts.hpp"

namespace grainsweep::bench {
namespace {

Sweep sweep_of(const std::string& scene) {
  const SweepReading reading = read_sweep(std::string(GRAINSWEEP_TRADE) + "/" + scene + ".json");
  for (const Diagnostic& diagnostic : reading.errors) FAIL(to_string(diagnostic));
  return reading.sweep;
}

/// Accuracies by their first packing, in the order of the sweep.
std::vector<JobFacts> accuracies_of(const Sweep& sweep) {
  std::vector<JobFacts> first;
  std::set<std::string> known;
  for (const Job& job : sweep.jobs) {
    if (known.insert(job.parameters.text()).second) first.push_back(facts_of(job));
  }
  return first;
}

TEST_CASE("every sweep of the trade settles the same starts with the presets and 20 others") {
  for (const char* scene : {"walls", "tube", "two-sizes", "tall", "no-walls", "pinacoids"}) {
    INFO(scene);
    const Sweep sweep = sweep_of(scene);
    const std::vector<JobFacts> accuracies = accuracies_of(sweep);
    std::set<std::string> presets;
    std::set<std::uint64_t> starts;
    std::size_t others = 0;
    for (const JobFacts& job : accuracies) {
      job.accuracy == "custom" ? void(++others) : void(presets.insert(job.accuracy));
    }
    for (const Job& job : sweep.jobs) starts.insert(job.spec.random_key);
    CHECK(starts.size() >= 64);
    CHECK(sweep.jobs.size() == starts.size() * accuracies.size());
    CHECK(others >= 20);
    CHECK(presets.contains("fast"));
    CHECK(presets.contains("balanced"));
    CHECK(presets.contains("accurate"));
  }
}

TEST_CASE("spheres are compared with exact rest, and pinacoids with the limit in f64") {
  for (const char* scene : {"walls", "tube", "two-sizes", "tall", "no-walls"}) {
    INFO(scene);
    CHECK(accuracies_of(sweep_of(scene)).front().accuracy == "exact");
  }
  const Accuracy limit = sweep_of("pinacoids").jobs.front().spec.accuracy;
  CHECK(limit.precision == Precision::f64);
  CHECK(limit.creep_steps == 1280);
  CHECK(limit.path_tolerance == 5e-5);
}

}  // namespace
}  // namespace grainsweep::bench
