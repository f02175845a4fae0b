#include "runner/tables/provenance.hpp"

#include <nlohmann/json.hpp>

#include "runner/hash.hpp"

namespace grainsweep {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunRecord, started, ended, wall_seconds, process, threads, isa,
                                   packings)

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

}  // namespace

std::string provenance_text(const Provenance& provenance, const std::vector<Row>& rows) {
  nlohmann::ordered_json text;
  text["program"] = {{"name", "grainsweep"},
                     {"version", provenance.build.version},
                     {"compiler", provenance.build.compiler},
                     {"libraries", provenance.build.libraries}};
  text["sweep_file"] = provenance.sweep_file;
  text["sweep_text_hash"] = provenance.sweep_text_hash;
  text["runs"] = json(provenance.runs);
  text["totals"] = to_json(totals_of(rows), rows.size());
  json sweep = jobs_json(rows);
  sweep["name"] = provenance.sweep_name;
  text["sweep"] = sweep;
  return text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

ProvenanceReading provenance_from_text(const std::string& text, Detail detail) {
  const json from = json::parse(text);
  ProvenanceReading reading;
  Provenance& provenance = reading.provenance;
  const json& program = from.at("program");
  program.at("version").get_to(provenance.build.version);
  program.at("compiler").get_to(provenance.build.compiler);
  program.at("libraries").get_to(provenance.build.libraries);
  from.at("sweep_file").get_to(provenance.sweep_file);
  from.at("sweep_text_hash").get_to(provenance.sweep_text_hash);
  from.at("runs").get_to(provenance.runs);
  const json& sweep = from.at("sweep");
  sweep.at("name").get_to(provenance.sweep_name);
  reading.rows = rows_from_json(sweep, detail);
  return reading;
}

std::string text_hash(std::string_view text) { return "fnv1a64:" + hex16(fnv1a(text)); }

Totals totals_of(const std::vector<Row>& rows) {
  Totals totals;
  for (const Row& row : rows) {
    count(row, totals.counts);
    if (row.outcome) totals.cpu_seconds += row.outcome->cpu_seconds;
  }
  return totals;
}

}  // namespace grainsweep
