#include "runner/tables/job_facts.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

std::string accuracy_name(const Accuracy& accuracy) {
  for (const Preset& preset : presets()) {
    if (preset.accuracy == accuracy) return std::string(preset.name);
  }
  return "custom";
}

/// The shape's name: parameters name it either as text or as an object with one member.
std::string shape_of(const std::string& parameters) {
  const json read = json::parse(parameters, nullptr, false);
  const json shape = read.is_object() ? read.value("shape", json("sphere")) : json("sphere");
  if (shape.is_string()) return shape.get<std::string>();
  return shape.is_object() && !shape.empty() ? shape.begin().key() : "sphere";
}

JobFacts facts_of(const Job& job) {
  JobFacts facts;
  facts.id = job.id;
  facts.label = job.label;
  facts.parameters = job.parameters;
  facts.replicate = job.replicate;
  facts.seed = job.seed;
  facts.shape = shape_of(job.parameters);
  facts.accuracy = accuracy_name(job.spec.accuracy);
  facts.box = job.spec.box;
  facts.small_share = job.spec.sizes.small_share;
  facts.measure = job.spec.measure;
  return facts;
}

Boundary boundary_from(const json& name) {
  return name.get<std::string>() == "walls" ? Boundary::walls : Boundary::periodic;
}

/// Everything that jobs with equal parameters share. The parameters are kept as the text that
/// identifies a job: written anew from numbers, 1e-04 would become 0.0001.
json shared_json(const JobFacts& job) {
  return {{"parameters", job.parameters},
          {"shape", job.shape},
          {"accuracy", job.accuracy},
          {"length", job.box.length},
          {"width", job.box.width},
          {"x", name_of(job.box.x)},
          {"y", name_of(job.box.y)},
          {"small_share", job.small_share},
          {"exclude_floor", job.measure.exclude_floor},
          {"exclude_surface", job.measure.exclude_surface},
          {"gap_tolerances", job.measure.gap_tolerances}};
}

JobFacts shared_facts_from(const json& set) {
  JobFacts facts;
  set.at("parameters").get_to(facts.parameters);
  set.at("shape").get_to(facts.shape);
  set.at("accuracy").get_to(facts.accuracy);
  set.at("length").get_to(facts.box.length);
  set.at("width").get_to(facts.box.width);
  facts.box.x = boundary_from(set.at("x"));
  facts.box.y = boundary_from(set.at("y"));
  set.at("small_share").get_to(facts.small_share);
  set.at("exclude_floor").get_to(facts.measure.exclude_floor);
  set.at("exclude_surface").get_to(facts.measure.exclude_surface);
  set.at("gap_tolerances").get_to(facts.measure.gap_tolerances);
  return facts;
}

}  // namespace

const char* name_of(Boundary boundary) {
  return boundary == Boundary::walls ? "walls" : "periodic";
}

SweepFacts facts_of(const Sweep& sweep) {
  SweepFacts facts{sweep.name, {}};
  for (const Job& job : sweep.jobs) facts.jobs.push_back(facts_of(job));
  return facts;
}

json to_json(const SweepFacts& sweep) {
  json sets = json::array(), jobs = json::array();
  std::map<std::string, std::size_t> index_of;
  for (const JobFacts& job : sweep.jobs) {
    const auto [known, is_new] = index_of.try_emplace(job.parameters, sets.size());
    if (is_new) sets.push_back(shared_json(job));
    jobs.push_back({{"id", job.id},
                    {"label", job.label},
                    {"replicate", job.replicate},
                    {"seed", job.seed},
                    {"set", known->second}});
  }
  return {{"name", sweep.name}, {"parameter_sets", sets}, {"jobs", jobs}};
}

SweepFacts sweep_facts_from_json(const json& from) {
  std::vector<JobFacts> sets;
  for (const json& set : from.at("parameter_sets")) sets.push_back(shared_facts_from(set));
  SweepFacts sweep{from.at("name").get<std::string>(), {}};
  for (const json& entry : from.at("jobs")) {
    const auto set = entry.at("set").get<std::size_t>();
    if (set >= sets.size()) throw json::out_of_range::create(401, "no such parameter set", &entry);
    JobFacts job = sets[set];
    entry.at("id").get_to(job.id);
    entry.at("label").get_to(job.label);
    entry.at("replicate").get_to(job.replicate);
    entry.at("seed").get_to(job.seed);
    sweep.jobs.push_back(std::move(job));
  }
  return sweep;
}

std::vector<Row> join(const SweepFacts& sweep, const std::map<std::string, Outcome>& outcomes) {
  std::vector<Row> rows;
  rows.reserve(sweep.jobs.size());
  for (const JobFacts& job : sweep.jobs) {
    const auto found = outcomes.find(job.id);
    rows.push_back({job, found == outcomes.end() ? std::nullopt : std::optional(found->second)});
  }
  return rows;
}

bool is_settled(const Row& row) {
  return row.outcome && row.outcome->result.status == PackingStatus::settled;
}

std::string status_of(const Row& row) {
  return row.outcome ? name_of(row.outcome->result.status) : "pending";
}

void count(std::optional<PackingStatus> status, StatusCounts& counts) {
  counts.settled += status == PackingStatus::settled ? 1 : 0;
  counts.not_settled += status == PackingStatus::not_settled ? 1 : 0;
  counts.failed += status == PackingStatus::failed ? 1 : 0;
  counts.pending += status ? 0 : 1;
}

void count(const Row& row, StatusCounts& counts) {
  count(row.outcome ? std::optional(row.outcome->result.status) : std::nullopt, counts);
}

bool is_measured(const Row& row) {
  return is_settled(row) ||
         (row.outcome && row.outcome->result.status == PackingStatus::not_settled);
}

Coordination headline_coordination(const Row& row) {
  if (!is_measured(row) || row.outcome->result.coordination.empty()) {
    return {no_number, no_number, no_number};
  }
  return row.outcome->result.coordination.front();
}

}  // namespace grainsweep
