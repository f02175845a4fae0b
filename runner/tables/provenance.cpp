#include "runner/tables/provenance.hpp"

#include <filesystem>
#include <system_error>

#include <nlohmann/json.hpp>

#include "runner/hash.hpp"

namespace grainsweep {

void to_json(nlohmann::json& json, const SweepFile& sweep) {
  json = {{"file", sweep.file}, {"folder", sweep.folder}, {"text", sweep.text}};
}
void from_json(const nlohmann::json& json, SweepFile& sweep) {
  json.at("file").get_to(sweep.file);
  json.at("text").get_to(sweep.text);
  sweep.folder = json.value("folder", "");
}

namespace {

/// The path of the file from the present folder, which may have been moved with it.
std::string name_from_here(const SweepFile& sweep) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path here = fs::current_path(unknown), file(sweep.file);
  if (unknown || sweep.folder.empty() || file.is_absolute() || here == sweep.folder) {
    return sweep.file;
  }
  const fs::path given = (fs::path(sweep.folder) / file).lexically_normal();
  const bool has_moved = !fs::exists(given, unknown) && fs::exists(file, unknown);
  return has_moved ? sweep.file : given.lexically_proximate(here).string();
}

using nlohmann::json;

json to_json(const Totals& totals, std::size_t packings) {
  return {{"packings", packings},
          {"settled", totals.counts.settled},
          {"not_settled", totals.counts.not_settled},
          {"failed", totals.counts.failed},
          {"pending", totals.counts.pending},
          {"cpu_seconds", totals.cpu_seconds}};
}

json to_json(const Units& units) {
  json text = {{"d", units.d}, {"unit", units.unit}};
  if (units.density) text["density"] = *units.density;
  return text;
}

GivenUnits units_from(const json& sweep) {
  const auto found = sweep.find("units");
  if (found == sweep.end()) return std::nullopt;
  Units units{found->at("d").get<double>(), found->at("unit").get<std::string>(), std::nullopt};
  if (found->contains("density")) units.density = found->at("density").get<double>();
  return units;
}

constexpr std::string_view before_checksum = ",\n  \"crc32\": \"";

/// The checksum of all before, and the end of the text.
std::string checksum_of(std::string_view part) {
  return std::string(before_checksum) + hex8(crc32(part)) + "\"\n}\n";
}

/// A job on a line of its own.
std::string entry_text(const JobEntry& job) {
  return json(job).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Puts the entries of the jobs where the text has an empty list.
std::string with_jobs(const std::string& text, const std::vector<JobEntry>& jobs) {
  constexpr std::string_view none =
      "\"jobs\": []";  // cannot be in a string, where quotes are escaped
  const std::size_t place = text.find(none) + none.size() - 1;
  constexpr std::size_t usual_entry = 100;  // bytes
  std::string whole;
  whole.reserve(text.size() + usual_entry * jobs.size());
  whole.append(text, 0, place);
  for (const JobEntry& job : jobs) {
    whole += (&job == &jobs.front() ? "\n      " : ",\n      ") + entry_text(job);
  }
  return whole.append(jobs.empty() ? "" : "\n    ").append(text, place);
}

/// Takes the jobs out of a text while it is read: 100,000 of them as JSON fill 150 MB.
class JobTaker {
 public:
  explicit JobTaker(std::vector<JobEntry>& jobs) : jobs_(jobs) {}

  /// As nlohmann::json::parser_callback_t; false for what was taken.
  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::key && depth == 2) is_in_jobs_ = parsed == "jobs";
    if (!is_in_jobs_ || event != json::parse_event_t::object_end || depth != 3) return true;
    jobs_.push_back(parsed.get<JobEntry>());
    return false;
  }

 private:
  std::vector<JobEntry>& jobs_;
  bool is_in_jobs_ = false;
};

}  // namespace

bool has_checksum(std::string_view text) {
  const std::size_t end = text.rfind(before_checksum);
  return end != std::string_view::npos && text.substr(end) == checksum_of(text.substr(0, end));
}

std::string sweep_file_of(const Provenance& provenance) {
  return provenance.sweeps.size() == 1 ? name_from_here(provenance.sweeps.front()) : "";
}

std::string provenance_text(const Provenance& provenance, const std::vector<Row>& rows) {
  nlohmann::ordered_json text;
  text["program"] = {{"name", "grainsweep"},
                     {"version", provenance.build.version},
                     {"commit", provenance.build.commit},
                     {"compiler", provenance.build.compiler},
                     {"libraries", provenance.build.libraries}};
  text["sweep_files"] = json(provenance.sweeps);
  text["runs"] = json(provenance.runs);
  text["totals"] = to_json(totals_of(rows), rows.size());
  const JobList list = job_list(rows);
  json sweep = {{"name", provenance.sweep_name}, {"jobs", json::array()}};
  sweep["parameter_sets"] = json::array();
  for (const JobFacts& set : list.sets) sweep["parameter_sets"].push_back(set_json(set));
  if (provenance.units) sweep["units"] = to_json(*provenance.units);
  text["sweep"] = sweep;
  std::string whole =
      with_jobs(text.dump(2, ' ', false, json::error_handler_t::replace), list.jobs);
  whole.resize(whole.size() - 2);  // without the last line, a brace
  return whole.append(checksum_of(whole));
}

ProvenanceReading provenance_from_text(const std::string& text) {
  ProvenanceReading reading;
  const json from = json::parse(text, JobTaker(reading.jobs.jobs));
  if (!has_checksum(text)) throw json::other_error::create(501, "its checksum is wrong", &from);
  Provenance& provenance = reading.provenance;
  const json& program = from.at("program");
  program.at("version").get_to(provenance.build.version);
  program.at("commit").get_to(provenance.build.commit);
  program.at("compiler").get_to(provenance.build.compiler);
  program.at("libraries").get_to(provenance.build.libraries);
  from.at("sweep_files").get_to(provenance.sweeps);
  from.at("runs").get_to(provenance.runs);
  const json& sweep = from.at("sweep");
  sweep.at("name").get_to(provenance.sweep_name);
  provenance.units = units_from(sweep);
  auto& [sets, jobs] = reading.jobs;
  for (const json& set : sweep.at("parameter_sets")) sets.push_back(set_from_json(set));
  for (const JobEntry& job : jobs) {
    if (job.set < sets.size()) continue;
    throw json::out_of_range::create(401, "no such parameter set", &sweep);
  }
  return reading;
}

Totals totals_of(const std::vector<Row>& rows) {
  Totals totals;
  for (const Row& row : rows) {
    count(row, totals.counts);
    if (row.outcome) totals.cpu_seconds += row.outcome->cpu_seconds;
  }
  return totals;
}

}  // namespace grainsweep
