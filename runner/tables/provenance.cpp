#include "runner/tables/provenance.hpp"

#include <nlohmann/json.hpp>

#include "runner/hash.hpp"

namespace grainsweep {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SweepFile, file, text)

namespace {

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

std::string with_checksum(std::string_view part) {
  return std::string(part).append(before_checksum).append(hex8(crc32(part))).append("\"\n}\n");
}

bool has_checksum(std::string_view text) {
  return text == with_checksum(text.substr(0, text.rfind(before_checksum)));
}

}  // namespace

std::string sweep_file_of(const Provenance& provenance) {
  return provenance.sweeps.size() == 1 ? provenance.sweeps.front().file : "";
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
  json sweep = jobs_json(rows);
  sweep["name"] = provenance.sweep_name;
  if (provenance.units) sweep["units"] = to_json(*provenance.units);
  text["sweep"] = sweep;
  const std::string whole = text.dump(2, ' ', false, json::error_handler_t::replace);
  return with_checksum(whole.substr(0, whole.size() - 2));  // without the last line, a brace
}

ProvenanceReading provenance_from_text(const std::string& text, Detail detail) {
  const json from = json::parse(text);
  if (!has_checksum(text)) throw json::other_error::create(501, "its checksum is wrong", &from);
  ProvenanceReading reading;
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
  reading.rows = rows_from_json(sweep, detail);
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
