#include "runner/tables/job_facts.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "engine/scene/sizes.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

constexpr const char* custom = "custom";

std::string accuracy_name(const Accuracy& accuracy) {
  for (const Preset& preset : presets()) {
    if (preset.accuracy == accuracy) return std::string(preset.name);
  }
  return custom;
}

std::string gap_tolerance(const JobFacts& job) {
  const auto& gaps = job.measure.gap_tolerances;
  return gaps.empty() ? "" : cell(gaps.front());
}

std::string start_file(const JobFacts& job) {
  for (const char* const path : {"fill.file", "fill.files"}) {
    const auto found = job.files.find(path);
    if (found != job.files.end()) return cell(found->second);
  }
  return "";
}

const char* boundary_name(const Box& box, Boundary boundary) {
  return box.is_tube ? "tube" : name_of(boundary);
}

Columns<JobFacts> all_job_columns() {
  using Job = const JobFacts&;
  const char* const boundary = "walls, periodic or tube";
  return {
      {"job", "", "id of the packing", [](Job job) { return job.id; }},
      {"label", "", "of the block of the sweep", [](Job job) { return cell(job.label); }},
      {"replicate", "", "number among packings of equal parameters, from 1",
       [](Job job) { return cell(job.replicate); }},
      {"seed", "", "of the sweep", [](Job job) { return cell(job.seed); }},
      {"start", "", "file its grains started from; empty if they were drawn at random", start_file},
      {"shape", "", "name of the grains' shape: sphere, pinacoid, cube, hull, ...",
       [](Job job) { return cell(job.shape); }},
      {"accuracy", "", "name of the preset, or custom", [](Job job) { return cell(job.accuracy); }},
      {"length", "d", "of the box along x, or the diameter of the tube",
       [](Job job) { return cell(job.box.length); }},
      {"width", "d", "of the box along y, the gap W between walls, or the diameter D of the tube",
       [](Job job) { return cell(job.box.width); }},
      {"boundary_x", "", boundary, [](Job job) { return cell(boundary_name(job.box, job.box.x)); }},
      {"boundary_y", "", boundary, [](Job job) { return cell(boundary_name(job.box, job.box.y)); }},
      {"small_share", "", "share of the solid volume in small grains",
       [](Job job) { return cell(job.small_share); }},
      {"gap_tolerance", "d", "grains with a smaller gap touch", gap_tolerance},
      {"parameters", "", "all of them, as canonical JSON",
       [](Job job) { return cell(job.parameters.text()); }},
  };
}

/// Adds the values below `path`; a list is one value.
void add_parameters(const json& value, const std::string& path,
                    std::map<std::string, std::string>& flat) {
  if (value.is_object()) {
    for (const auto& [key, part] : value.items()) {
      add_parameters(part, path.empty() ? key : path + "." + key, flat);
    }
  } else if (value.is_number_float()) {
    flat[path] = cell(value.get<double>());
  } else {
    flat[path] = cell(value.is_string() ? value.get<std::string>() : value.dump());
  }
}

Boundary boundary_from(const json& name) {
  return name.get<std::string>() == "walls" ? Boundary::walls : Boundary::periodic;
}

}  // namespace

Columns<JobFacts> job_columns(const std::vector<std::string>& names) {
  const Columns<JobFacts> all = all_job_columns();
  Columns<JobFacts> chosen;
  for (const std::string& name : names) {
    chosen.push_back(*std::find_if(all.begin(), all.end(),
                                   [&](const auto& column) { return column.name == name; }));
  }
  return chosen;
}

std::map<std::string, std::string> identifying_parameters(const JobFacts& job) {
  std::map<std::string, std::string> flat;
  add_parameters(json::parse(job.parameters.text()), "", flat);
  return flat;
}

std::map<std::string, std::string> flat_parameters(const JobFacts& job) {
  std::map<std::string, std::string> flat = identifying_parameters(job);
  for (const auto& [path, file] : job.files) {
    if (flat.contains(path) && path != "fill.files") flat[path] = cell(file);
  }
  return flat;
}

std::set<std::string> idle_parameters(const JobFacts& job) {
  const auto parameters_of_job = identifying_parameters(job);
  PackingSpec spec;  // with what decides it
  const auto share = parameters_of_job.find("sizes.small_share");
  spec.sizes.small_share = share == parameters_of_job.end() ? 1.0 : std::stod(share->second);
  const bool is_from_file =
      parameters_of_job.contains("fill.file") || parameters_of_job.contains("fill.files");
  if (is_from_file) spec.fill = PlacedGrains{};
  std::set<std::string> idle;
  for (const auto& [path, value] : parameters_of_job) {
    const auto known = find_parameter(path);
    if (known && !idle_reason(parameters()[*known], spec).empty()) idle.insert(path);
  }
  return idle;
}

double small_class_limit(const JobFacts& job) {
  const auto parameters = flat_parameters(job);
  const auto ratio = parameters.find("sizes.size_ratio");
  SizesSpec sizes;
  sizes.small_share = job.small_share;
  if (ratio != parameters.end()) sizes.size_ratio = std::stod(ratio->second);
  return small_class_limit(sizes);
}

std::optional<ProtocolBias> bias_bound(const JobFacts& job) {
  const std::string& preset = job.settles_as.empty() ? job.accuracy : job.settles_as;
  auto bound = job.kind ? bias_bound(preset, *job.kind) : std::nullopt;
  if (bound && job.measure.gap_tolerances.front() != measured_gap) bound->coordination = no_number;
  return bound;
}

const char* name_of(Boundary boundary) {
  return boundary == Boundary::walls ? "walls" : "periodic";
}

std::string width_text(const std::string& width, Boundary y) {
  return y == Boundary::walls ? width : width + " " + name_of(y);
}

JobFacts facts_of(const Job& job) {
  JobFacts facts;
  static_cast<JobName&>(facts) = {job.id, job.label, job.replicate, job.seed, job.files};
  facts.parameters = job.parameters;
  facts.shape = name_of(job.spec.shape);
  facts.accuracy = accuracy_name(job.spec.accuracy);
  if (!has_preset(facts)) facts.settles_as = settles_as(job.spec.accuracy);
  facts.box = job.spec.box;
  facts.small_share = job.spec.sizes.small_share;
  facts.kind = bed_kind(job.spec);
  facts.measure = job.spec.measure;
  return facts;
}

std::vector<Row> rows_of(const Sweep& sweep) {
  std::vector<Row> rows;
  rows.reserve(sweep.jobs.size());
  const std::vector<Cost> costs = costs_of(sweep.jobs);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    JobFacts facts = facts_of(sweep.jobs[i]);
    facts.estimated = costs[i].cpu_seconds;
    rows.push_back({std::move(facts), std::nullopt});
  }
  return rows;
}

std::size_t take_outcomes(Outcomes&& outcomes, std::vector<Row>& rows) {
  for (Row& row : rows) {
    auto found = outcomes.extract(row.job.id);
    if (found) row.outcome = std::move(found.mapped());
  }
  return outcomes.size();
}

void to_json(json& to, const JobEntry& job) {
  to = {{"id", job.id},
        {"label", job.label},
        {"replicate", job.replicate},
        {"seed", job.seed},
        {"set", job.set}};
  if (!job.files.empty()) to["files"] = job.files;
}

void from_json(const json& from, JobEntry& job) {
  from.at("id").get_to(job.id);
  from.at("label").get_to(job.label);
  from.at("replicate").get_to(job.replicate);
  from.at("seed").get_to(job.seed);
  if (const auto files = from.find("files"); files != from.end()) files->get_to(job.files);
  from.at("set").get_to(job.set);
}

JobList job_list(const std::vector<Row>& rows) {
  JobList list;
  std::map<std::string_view, std::size_t> index_of;
  list.jobs.reserve(rows.size());
  for (const auto& [job, outcome] : rows) {
    const auto [known, is_new] = index_of.try_emplace(job.parameters.text(), list.sets.size());
    if (is_new) list.sets.push_back(job);
    list.jobs.push_back({static_cast<const JobName&>(job), known->second});
  }
  return list;
}

JobFacts facts_of(const JobEntry& job, const JobList& list) {
  JobFacts facts = list.sets[job.set];
  static_cast<JobName&>(facts) = static_cast<const JobName&>(job);
  return facts;
}

std::vector<Row> rows_of(const JobList& list, Detail detail) {
  std::vector<Row> rows;
  rows.reserve(list.jobs.size());
  for (const JobEntry& job : list.jobs) {
    Row& row = rows.emplace_back();
    if (detail == Detail::whole) {
      row.job = facts_of(job, list);
    } else {
      row.job.id = job.id;
      row.job.estimated = list.sets[job.set].estimated;
    }
  }
  return rows;
}

/// Everything that jobs with equal parameters share. The parameters are kept as the text that
/// identifies a job: written anew from numbers, 1e-04 would become 0.0001.
json set_json(const JobFacts& job) {
  return {{"parameters", job.parameters.text()},
          {"shape", job.shape},
          {"accuracy", job.accuracy},
          {"settles_as", job.settles_as},
          {"estimated_cpu_seconds", job.estimated},
          {"length", job.box.length},
          {"width", job.box.width},
          {"x", name_of(job.box.x)},
          {"y", name_of(job.box.y)},
          {"tube", job.box.is_tube},
          {"small_share", job.small_share},
          {"kind", job.kind ? name_of(*job.kind) : ""},
          {"exclude_floor", job.measure.exclude_floor},
          {"exclude_surface", job.measure.exclude_surface},
          {"gap_tolerances", job.measure.gap_tolerances}};
}

JobFacts set_from_json(const json& set) {
  JobFacts facts;
  facts.parameters = set.at("parameters").get<std::string>();
  set.at("shape").get_to(facts.shape);
  set.at("accuracy").get_to(facts.accuracy);
  set.at("settles_as").get_to(facts.settles_as);
  set.at("estimated_cpu_seconds").get_to(facts.estimated);
  set.at("length").get_to(facts.box.length);
  set.at("width").get_to(facts.box.width);
  facts.box.x = boundary_from(set.at("x"));
  facts.box.y = boundary_from(set.at("y"));
  set.at("tube").get_to(facts.box.is_tube);
  set.at("small_share").get_to(facts.small_share);
  facts.kind = bed_kind_called(set.at("kind").get<std::string>());
  set.at("exclude_floor").get_to(facts.measure.exclude_floor);
  set.at("exclude_surface").get_to(facts.measure.exclude_surface);
  set.at("gap_tolerances").get_to(facts.measure.gap_tolerances);
  return facts;
}

bool is_settled(const Row& row) {
  return row.outcome && row.outcome->result.status == PackingStatus::settled;
}

bool is_measured(const Row& row) {
  return is_settled(row) ||
         (row.outcome && row.outcome->result.status == PackingStatus::not_settled);
}

std::string status_of(const Row& row) {
  return row.outcome ? name_of(row.outcome->result.status) : "pending";
}

std::string words_of(PackingStatus status) {
  return status == PackingStatus::not_settled ? "not settled" : name_of(status);
}

std::string status_words(const Row& row) {
  return row.outcome ? words_of(row.outcome->result.status) : status_of(row);
}

bool is_made(const Row& row) { return row.outcome && !row.outcome->exception; }

void count(const Row& row, StatusCounts& counts) {
  counts.broken_off += row.outcome && !is_made(row) ? 1 : 0;
  if (!is_made(row))
    ++counts.pending;
  else if (is_settled(row))
    ++counts.settled;
  else if (is_measured(row))
    ++counts.not_settled;
  else
    ++counts.failed;
}

}  // namespace grainsweep
