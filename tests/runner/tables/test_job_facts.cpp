#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/tables/job_facts.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

Job sample_source() {
  Job job;
  job.id = "0123456789abcdef";
  job.label = "MSP";
  job.parameters = sample_parameters(5.0, Boundary::walls, 0.25);
  job.replicate = 2;
  job.seed = 18446744073709551615u;
  job.spec.box = {20.0, 5.0, Boundary::periodic, Boundary::walls};
  job.spec.sizes.small_share = 0.25;
  job.spec.accuracy = presets().front().accuracy;
  return job;
}

TEST_CASE("facts name what a job is made of") {
  const JobFacts job = facts_of(sample_source());
  CHECK(job.id == "0123456789abcdef");
  CHECK(job.shape == "sphere");
  CHECK(job.accuracy == presets().front().name);
  CHECK(job.small_share == 0.25);
  CHECK(job.box.y == Boundary::walls);
}

TEST_CASE("a shape is known by its name, whatever parts it has") {
  Job job = sample_source();
  job.spec.shape = PinacoidSize{};
  CHECK(facts_of(job).shape == "pinacoid");
  job.spec.shape = HullVertices{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  CHECK(facts_of(job).shape == "hull");
}

TEST_CASE("an accuracy that is no preset is called custom") {
  Job job = sample_source();
  job.spec.accuracy.max_steps = 31;
  CHECK(facts_of(job).accuracy == "custom");
}

TEST_CASE("another precision leaves a packing the bounds of its preset, another step does not") {
  Job job = sample_source();
  job.parameters = sample_parameters(5.0, Boundary::walls, 0.0);
  job.spec.sizes.small_share = 0.0;
  job.spec.accuracy.precision = Precision::f64;
  CHECK(facts_of(job).accuracy == "custom");
  REQUIRE(bias_bound(facts_of(job)));
  CHECK(bias_bound(facts_of(job))->coordination ==
        bias_bound("fast", BedKind::spheres)->coordination);
  const std::vector<Row> rows = rows_of(Sweep{"s", 7, 1, {job}});
  CHECK(bias_bound(set_from_json(set_json(rows.at(0).job))));
  job.spec.accuracy.step = 0.1;
  CHECK_FALSE(bias_bound(facts_of(job)));
}

TEST_CASE("the bias of Z is bounded at the gap at which it was measured, and only there") {
  JobFacts job;
  job.kind = BedKind::spheres;
  job.accuracy = "fast";
  CHECK(bias_bound(job)->coordination == bias_bound("fast", BedKind::spheres)->coordination);
  job.measure.gap_tolerances = {1e-6, 1e-4};
  REQUIRE(bias_bound(job));
  CHECK(std::isnan(bias_bound(job)->coordination));
  CHECK(bias_bound(job)->solid_fraction == bias_bound("fast", BedKind::spheres)->solid_fraction);
}

TEST_CASE("the bias of packings is bounded by their kind and the preset they settle as") {
  JobFacts job;
  job.kind = BedKind::two_sizes;
  job.accuracy = "custom";
  CHECK_FALSE(bias_bound(job));
  job.settles_as = "balanced";
  CHECK(bias_bound(job)->solid_fraction ==
        bias_bound("balanced", BedKind::two_sizes)->solid_fraction);
  CHECK(set_from_json(set_json(job)).kind == BedKind::two_sizes);
  job.kind.reset();
  CHECK_FALSE(bias_bound(job));
  CHECK_FALSE(set_from_json(set_json(job)).kind);
}

/// What the JSON of a list says.
std::string text_of(const JobList& list) {
  nlohmann::json sets = nlohmann::json::array();
  for (const JobFacts& set : list.sets) sets.push_back(set_json(set));
  return nlohmann::json{{"sets", sets}, {"jobs", list.jobs}}.dump();
}

JobList read_back(const JobList& list) {
  const nlohmann::json from = nlohmann::json::parse(text_of(list));
  JobList back{{}, from.at("jobs").get<std::vector<JobEntry>>()};
  for (const auto& set : from.at("sets")) back.sets.push_back(set_from_json(set));
  return back;
}

TEST_CASE("jobs read back from JSON are the same, equal parameters kept once") {
  Job second = sample_source();
  second.id = "fedcba9876543210";
  second.replicate = 3;
  second.files = {{"fill.files", "b.csv"}};
  const std::vector<Row> rows = rows_of(Sweep{"s", 7, 3, {sample_source(), second}});
  CHECK(job_list(rows).sets.size() == 1);
  const std::vector<Row> back = rows_of(read_back(job_list(rows)));
  CHECK(text_of(job_list(back)) == text_of(job_list(rows)));
  REQUIRE(back.size() == 2);
  CHECK(back[1].job.replicate == 3);
  CHECK(back[1].job.files == second.files);
  CHECK(back[1].job.seed == 18446744073709551615u);
  CHECK(back[1].job.box.width == 5.0);
  CHECK(back[1].job.measure.gap_tolerances == rows[1].job.measure.gap_tolerances);
}

TEST_CASE("parameters read back letter by letter: they are the identity of a job") {
  JobFacts job = sample_job("a", 5);
  job.parameters = R"({"accuracy":{"overlap_tolerance":1e-04,"momentum":1},"shape":"sphere"})";
  CHECK(rows_of(read_back(job_list({{job, {}}}))).at(0).job.parameters == job.parameters);
}

TEST_CASE("the file of a start stands among the parameters, a list of files as it is") {
  JobFacts job = sample_job("a", 5);
  job.parameters = R"({"fill":{"file":"of its content"}})";
  job.files = {{"fill.file", "b.csv"}};
  CHECK(identifying_parameters(job).at("fill.file") == "of its content");
  CHECK(flat_parameters(job).at("fill.file") == "b.csv");
  job.parameters = R"({"fill":{"files":["one","two"]}})";
  job.files = {{"fill.files", "b.csv"}};  // that of this replicate
  CHECK(flat_parameters(job) == identifying_parameters(job));
}

TEST_CASE("rows take the outcomes of their jobs, others are orphaned") {
  std::vector<Row> rows = {
      {sample_job("b", 5), {}}, {sample_job("a", 5), {}}, {sample_job("c", 5), {}}};
  CHECK(take_outcomes({{"a", sample_outcome("a", 0.6, 6)},
                       {"b", sample_outcome("b", 0.6, 6)},
                       {"x", sample_outcome("x", 0.6, 6)}},
                      rows) == 1);
  CHECK(rows[0].outcome->job == "b");
  CHECK(rows[1].outcome->job == "a");
  CHECK(status_of(rows[2]) == "pending");
}

TEST_CASE("only a settled packing counts as settled, an unsettled one is still measured") {
  CHECK(is_settled(settled_row("a", 5, 0.6, 6)));
  const Row unsettled = row_with_status("a", 5, PackingStatus::not_settled, "moves");
  CHECK_FALSE(is_settled(unsettled));
  CHECK(is_measured(unsettled));
  const Row failed = row_with_status("a", 5, PackingStatus::failed, "no room");
  CHECK_FALSE(is_measured(failed));
}

TEST_CASE("all grains are small where there is no large class, and none where no small one") {
  JobFacts job = sample_job("a", 5, 1, Boundary::walls, 0.4);
  CHECK(small_class_limit(job) == Approx(0.5 / 1.5));  // between 0.25 and 0.5 d
  job.small_share = 1.0;
  CHECK(std::isinf(small_class_limit(job)));
  CHECK(small_class_limit(sample_job("b", 5)) == 0.0);
}

TEST_CASE("rows of equal parameters share their text") {
  std::vector<Row> rows;
  for (const double width : {4.0, 5.0}) {
    for (const int replicate : {1, 2}) {
      rows.push_back({sample_job(std::to_string(rows.size()), width, replicate), std::nullopt});
    }
  }
  const std::vector<Row> back = rows_of(job_list(rows));
  REQUIRE(back.size() == 4);
  CHECK(&back[0].job.parameters.text() == &back[1].job.parameters.text());
  CHECK(&back[2].job.parameters.text() == &back[3].job.parameters.text());
  CHECK_FALSE(back[1].job.parameters == back[2].job.parameters);
}

}  // namespace
}  // namespace grainsweep
