#include <catch2/catch.hpp>

#include "bench/trade/scene.hpp"
#include "runner/commands/results.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/stored.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep::bench {
namespace {

Setting with_parts(const std::string& preset, const Parts& parts) {
  Setting setting;
  setting.preset = preset;
  setting.parts = parts;
  return setting;
}

JobFacts job_with(const std::string& id, int start, const std::string& accuracy,
                  const std::string& step) {
  JobFacts job = sample_job(id, 5, start);
  job.parameters = R"({"accuracy":{"creep_steps":480,"rest":"in_steps","step":)" + step +
                   R"(},"box":{"width":5}})";
  job.accuracy = accuracy;
  return job;
}

void add_settled(const std::string& folder, const std::string& job, double solid_fraction,
                 double cpu_seconds) {
  Outcome outcome = sample_outcome(job, solid_fraction, 6.0);
  outcome.cpu_seconds = cpu_seconds;
  add_stored_bed(folder, bed_of(outcome, 0, sample_curves()), outcome);
  add_outcomes(folder, {outcome});
}

TEST_CASE("settings are named by the preset from which they differ least") {
  Scene scene{
      "",
      {with_parts("balanced", {{"creep_steps", "480"}, {"rest", "in_steps"}, {"step", "0.2"}}),
       with_parts("fast", {{"creep_steps", "240"}, {"rest", "in_steps"}, {"step", "0.2"}}),
       with_parts("", {{"creep_steps", "240"}, {"rest", "in_steps"}, {"step", "0.4"}}),
       with_parts("", {{"creep_steps", "480"}, {"rest", "in_steps"}, {"step", "0.1"}})}};
  name_settings(scene);
  CHECK(scene.settings[0].name == "balanced");
  CHECK(scene.settings[1].name == "fast");
  CHECK(scene.settings[2].name == "fast, step 0.4");
  CHECK(scene.settings[3].name == "balanced, step 0.1");
}

TEST_CASE("a setting is found by its parts") {
  const Scene scene{"", {with_parts("a", {{"step", "1"}}), with_parts("b", {{"step", "2"}})}};
  CHECK(find_setting(scene, {{"step", "2"}}) == &scene.settings[1]);
  CHECK(find_setting(scene, {{"step", "3"}}) == nullptr);
}

TEST_CASE("a folder holds the settings of a scene, with values of what settled, by start") {
  const TemporaryFolder folder;
  add_settled(folder.path(), "a1", 0.60, 1.5);
  add_settled(folder.path(), "a2", 0.61, 2.5);
  add_settled(folder.path(), "b2", 0.62, 3.5);
  Outcome sliding = sample_outcome("b1", 0.5, 5.0);
  sliding.result.status = PackingStatus::not_settled;
  add_outcomes(folder.path(), {sliding});
  const std::vector<Row> rows = {{job_with("a1", 1, "balanced", "0.2"), std::nullopt},
                                 {job_with("a2", 2, "balanced", "0.2"), std::nullopt},
                                 {job_with("b1", 1, "custom", "0.4"), std::nullopt},
                                 {job_with("b2", 2, "custom", "0.4"), std::nullopt},
                                 {job_with("b3", 3, "custom", "0.4"), std::nullopt}};
  Provenance provenance;
  provenance.sweeps = {{"a.json", ""}};
  provenance.runs.emplace_back();
  write_provenance(folder.path(), provenance, rows);

  const Scene scene = read_scene(folder.path());
  CHECK(scene.name == "MSP");
  REQUIRE(scene.settings.size() == 2);
  const Setting& first = scene.settings[0];
  CHECK(first.preset == "balanced");
  CHECK(first.solid_fraction == ByStart{{1, 0.60}, {2, 0.61}});
  CHECK(first.cpu_seconds == std::vector<double>{1.5, 2.5});
  CHECK(first.force_square.at(1) == 1.6);
  const ProfileBin wall = sample_curves().profile_y.bins[0],
                   next = sample_curves().profile_y.bins[1];
  REQUIRE(first.layers.at(2).size() == 2);
  CHECK(first.layers.at(2)[0] == std::vector{wall.large + wall.small, next.large + next.small});
  CHECK(first.layers.at(2)[1] == std::vector{next.large + next.small, wall.large + wall.small});
  CHECK(first.half_gap == 2.5);

  const Setting& second = scene.settings[1];
  CHECK(second.name == "balanced, step 0.4");
  CHECK(second.preset.empty());
  CHECK(second.planned == 3);
  CHECK(second.made == 2);
  CHECK(second.settled == 1);
  CHECK(second.solid_fraction == ByStart{{2, 0.62}});
  CHECK(second.cpu_seconds.size() == 2);  // that of a bed that does not settle counts as well
  CHECK_FALSE(second.is_exact());
}

}  // namespace
}  // namespace grainsweep::bench
