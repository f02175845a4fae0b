// The jobs of a sweep as tables need them, and what came of each: enough to write every table from
// an output folder alone, without the sweep file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/store/boxed.hpp"
#include "runner/store/journal.hpp"
#include "runner/sweep/job.hpp"
#include "runner/sweep/shared_text.hpp"
#include "runner/tables/columns.hpp"

namespace grainsweep {

/// What tells a job from the others with its parameters.
struct JobName {
  std::string id, label;
  int replicate = 1;
  std::uint64_t seed = 0;
  std::map<std::string, std::string> files;  ///< as Job::files
};

struct JobFacts : JobName {
  SharedText parameters;   ///< canonical JSON, as Job::parameters
  std::string shape;       ///< its name: "sphere", "cube", "hull"
  std::string accuracy;    ///< name of a preset, or "custom"
  std::string settles_as;  ///< for a custom one: the preset that has its bounds; "" if none has
  Box box;
  double small_share = 0.0;
  std::optional<BedKind> kind;  ///< among those whose protocol error was measured
  MeasureSpec measure;
  double estimated = 0.0;  ///< CPU time by estimate, s
};

/// Whether its grains are a mixture of shapes.
inline bool is_mixture(const JobFacts& job) { return job.shape == "mixture"; }
inline bool has_preset(const JobFacts& job) { return job.accuracy != "custom"; }

/// A job and what came of it; no outcome while it is pending.
struct Row {
  JobFacts job;
  Boxed<Outcome> outcome;
};

/// What tables need of a job, but for its estimate.
JobFacts facts_of(const Job& job);

/// One pending row per job, in the sweep's order.
std::vector<Row> rows_of(const Sweep& sweep);

/// Moves the outcome of each row's job into it; returns how many outcomes are orphaned, their jobs
/// not among the rows.
std::size_t take_outcomes(Outcomes&& outcomes, std::vector<Row>& rows);

/// A job of a JobList.
struct JobEntry : JobName {
  std::size_t set = 0;  ///< its parameters, by their place in JobList::sets
};
void to_json(nlohmann::json& to, const JobEntry& job);
void from_json(const nlohmann::json& from, JobEntry& job);

/// Jobs as kept in provenance.json: equal parameters once, so that 100,000 take 20 MB.
struct JobList {
  std::vector<JobFacts> sets;  ///< all but their JobName
  std::vector<JobEntry> jobs;
};
JobList job_list(const std::vector<Row>& rows);

/// What is known of a job of the list.
JobFacts facts_of(const JobEntry& job, const JobList& list);

/// Pending rows; for a summary without parameters.
std::vector<Row> rows_of(const JobList& list, Detail detail = Detail::whole);

/// A set of parameters, and back. Throws nlohmann::json::exception.
nlohmann::json set_json(const JobFacts& job);
JobFacts set_from_json(const nlohmann::json& set);

/// Columns of jobs, those with these names in this order: "label", "width" ...
Columns<JobFacts> job_columns(const std::vector<std::string>& names);

/// Dotted name -> cell of every parameter of a job; for a file, its name as written.
std::map<std::string, std::string> flat_parameters(const JobFacts& job);

/// The same, but with what a file holds, or a hash of it, in the place of its name.
std::map<std::string, std::string> identifying_parameters(const JobFacts& job);

/// The parameters of a job that its packing does not depend on: the ratio of two sizes without
/// small grains, and sizes where a file has them.
std::set<std::string> idle_parameters(const JobFacts& job);

/// Radius below which its grains count as small, d, as in engine/scene/sizes.hpp: 0 where none do,
/// infinite where all do.
double small_class_limit(const JobFacts& job);

/// Bound of the bias that the way of settling gives the means of such packings; none where it was
/// not measured: accuracies that settle like no preset, hulls, pinacoids of other proportions, and
/// small grains that are not half as large.
std::optional<ProtocolBias> bias_bound(const JobFacts& job);

/// "walls" or "periodic".
const char* name_of(Boundary boundary);

/// A width, written in d or another unit, and "periodic" after one without walls.
std::string width_text(const std::string& width, Boundary y);

/// Whether the row's values may enter means and fits.
bool is_settled(const Row& row);

/// Whether the row holds measured values, settled or not.
bool is_measured(const Row& row);

/// "settled", "not_settled", "failed" or "pending".
std::string status_of(const Row& row);

/// The same as people read it: "not settled" where tables have not_settled.
std::string words_of(PackingStatus status);
std::string status_words(const Row& row);

/// Whether it was made. One that broke off, by an exception, is made by the next run.
bool is_made(const Row& row);

/// Packings by status.
struct StatusCounts {
  int settled = 0, not_settled = 0, failed = 0;
  int pending = 0;     ///< not made yet, or broken off
  int broken_off = 0;  ///< of these: by an exception, as where there is no memory
};

/// Counts one more.
void count(const Row& row, StatusCounts& counts);

}  // namespace grainsweep
