// What tables need to know of a sweep: enough to write every one of them from an output folder
// alone, without the sweep file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "runner/store/outcome.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

struct JobFacts {
  std::string id;
  std::string label;
  std::string parameters;  ///< canonical JSON, as Job::parameters
  int replicate = 1;
  std::uint64_t seed = 0;
  std::string shape;     ///< "sphere", "pinacoid" or "hull"
  std::string accuracy;  ///< name of a preset, or "custom"
  Box box;
  double small_share = 0.0;
  MeasureSpec measure;
};

struct SweepFacts {
  std::string name;
  std::vector<JobFacts> jobs;  ///< in the sweep's order
};

SweepFacts facts_of(const Sweep& sweep);

/// As kept in provenance.json. Equal parameters are kept once.
nlohmann::json to_json(const SweepFacts& sweep);
/// Throws nlohmann::json::exception if `from` is not what to_json makes.
SweepFacts sweep_facts_from_json(const nlohmann::json& from);

/// A job and what came of it; no outcome while it is pending.
struct Row {
  JobFacts job;
  std::optional<Outcome> outcome;
};

/// One row per job, in the sweep's order. Outcomes of other jobs are left out.
std::vector<Row> join(const SweepFacts& sweep, const std::map<std::string, Outcome>& outcomes);

/// "walls" or "periodic".
const char* name_of(Boundary boundary);

/// Whether the row's values may enter means and fits.
bool is_settled(const Row& row);

/// "settled", "not_settled", "failed" or "pending".
std::string status_of(const Row& row);

/// Packings by status.
struct StatusCounts {
  int settled = 0, not_settled = 0, failed = 0, pending = 0;
};

/// Counts one more; no status while it is pending.
void count(std::optional<PackingStatus> status, StatusCounts& counts);
void count(const Row& row, StatusCounts& counts);

/// Whether the row holds measured values, settled or not.
bool is_measured(const Row& row);

/// The coordination at the job's first gap tolerance; NaN if nothing was measured.
Coordination headline_coordination(const Row& row);

}  // namespace grainsweep
