#include "runner/tables/provenance.hpp"

#include <array>
#include <cinttypes>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace grainsweep {
namespace {

using nlohmann::json;

json to_json(const RunRecord& run) {
  return {{"started", run.started},
          {"ended", run.ended.empty() ? json(nullptr) : json(run.ended)},
          {"wall_seconds", run.wall_seconds},
          {"process", run.process},
          {"threads", run.threads},
          {"isa", run.isa},
          {"packings", run.packings}};
}

RunRecord run_from(const json& from) {
  RunRecord run;
  from.at("started").get_to(run.started);
  if (!from.at("ended").is_null()) from.at("ended").get_to(run.ended);
  from.at("wall_seconds").get_to(run.wall_seconds);
  from.at("process").get_to(run.process);
  from.at("threads").get_to(run.threads);
  from.at("isa").get_to(run.isa);
  from.at("packings").get_to(run.packings);
  return run;
}

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
  json runs = json::array();
  for (const RunRecord& run : provenance.runs) runs.push_back(to_json(run));
  text["runs"] = runs;
  text["totals"] = to_json(totals_of(rows), rows.size());
  text["sweep"] = to_json(provenance.sweep);
  return text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Provenance provenance_from_text(const std::string& text) {
  const json from = json::parse(text);
  Provenance provenance;
  const json& program = from.at("program");
  program.at("version").get_to(provenance.build.version);
  program.at("compiler").get_to(provenance.build.compiler);
  program.at("libraries").get_to(provenance.build.libraries);
  from.at("sweep_file").get_to(provenance.sweep_file);
  from.at("sweep_text_hash").get_to(provenance.sweep_text_hash);
  for (const json& run : from.at("runs")) provenance.runs.push_back(run_from(run));
  provenance.sweep = sweep_facts_from_json(from.at("sweep"));
  return provenance;
}

std::string text_hash(std::string_view text) {
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const char byte : text) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3u;
  }
  std::array<char, 32> hex{};
  std::snprintf(hex.data(), hex.size(), "fnv1a64:%016" PRIx64, hash);
  return hex.data();
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
