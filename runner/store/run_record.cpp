#include "runner/store/run_record.hpp"

#include <algorithm>
#include <tuple>

#include <nlohmann/json.hpp>

namespace grainsweep {

using nlohmann::json;

void to_json(json& to, const RunRecord& run) {
  to = {{"started", run.started},   {"ended", run.ended},
        {"process", run.process},   {"wall_seconds", run.wall_seconds},
        {"threads", run.threads},   {"isa", run.isa},
        {"packings", run.packings}, {"command", run.command},
        {"host", run.host},         {"processor", run.processor},
        {"cores", run.cores},       {"commit", run.commit},
        {"form", run.form}};
}

void from_json(const json& from, RunRecord& run) {
  from.at("started").get_to(run.started);
  from.at("ended").get_to(run.ended);
  from.at("process").get_to(run.process);
  from.at("wall_seconds").get_to(run.wall_seconds);
  from.at("threads").get_to(run.threads);
  from.at("isa").get_to(run.isa);
  from.at("packings").get_to(run.packings);
  from.at("command").get_to(run.command);
  from.at("host").get_to(run.host);
  from.at("processor").get_to(run.processor);
  from.at("cores").get_to(run.cores);
  from.at("commit").get_to(run.commit);
  run.form = from.value("form", "");  // earlier versions did not tell
}

bool is_same_run(const RunRecord& a, const RunRecord& b) {
  return a.process == b.process && a.started == b.started;
}

void sort_runs(std::vector<RunRecord>& runs) {
  std::sort(runs.begin(), runs.end(), [](const RunRecord& a, const RunRecord& b) {
    return std::tie(a.started, a.process) < std::tie(b.started, b.process);
  });
}

}  // namespace grainsweep
