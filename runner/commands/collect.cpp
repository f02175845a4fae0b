// The command `collect`: the results of several output folders in one.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <utility>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/states.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

/// The merged folder while it grows.
struct Collection {
  std::string folder;
  Provenance provenance;
  std::set<std::string> jobs;               ///< ids in the provenance's sweep
  std::map<std::string, Outcome> outcomes;  ///< stored in the folder, by job
  std::size_t added = 0;
};

void warn(const std::string& text) { std::cerr << "warning: " << text << "\n"; }

void add_sweep(const Provenance& from, Collection& to) {
  for (const JobFacts& job : from.sweep.jobs) {
    if (to.jobs.insert(job.id).second) to.provenance.sweep.jobs.push_back(job);
  }
}

void add_runs(const std::vector<RunRecord>& from, std::vector<RunRecord>& to) {
  const auto is_known = [&](const RunRecord& run) {
    return std::any_of(to.begin(), to.end(), [&](const RunRecord& known) {
      return known.process == run.process && known.started == run.started;
    });
  };
  std::copy_if(from.begin(), from.end(), std::back_inserter(to),
               [&](const RunRecord& run) { return !is_known(run); });
}

/// Name and file of one sweep, or both names and no file to go on with.
void add_name(const Provenance& from, Provenance& to) {
  if (from.sweep.name != to.sweep.name) to.sweep.name += "+" + from.sweep.name;
  if (from.sweep_text_hash == to.sweep_text_hash) return;
  to.sweep_file.clear();
  to.sweep_text_hash.clear();
}

bool is_same_result(const Outcome& a, const Outcome& b) {
  return a.result.state_hash == b.result.state_hash && a.result.status == b.result.status;
}

/// The bed of a stored packing; nothing, and a warning, if it is missing or damaged.
std::optional<StoredBed> whole_bed(const std::string& folder, const std::string& job) {
  try {
    return read_bed(folder, job);
  } catch (const FileError& error) {
    warn(std::string(error.what()) + "; left out");
    return std::nullopt;
  }
}

void add_outcome(const std::string& folder, const Outcome& outcome, Journal& journal,
                 Collection& to) {
  const auto known = to.outcomes.find(outcome.job);
  if (known != to.outcomes.end() && !known->second.threw) {
    if (!outcome.threw && !is_same_result(outcome, known->second)) {
      warn(folder + ": its packing " + outcome.job + " (version " + outcome.version +
           ") differs from the one collected before (version " + known->second.version +
           "), which is kept");
    }
    return;
  }
  if (outcome.stored_grains > 0) {
    const auto bed = whole_bed(folder, outcome.job);
    if (!bed) return;
    write_bed(to.folder, outcome.job, *bed);
  }
  journal.append(outcome);
  to.outcomes[outcome.job] = outcome;
  ++to.added;
}

/// What the folder holds already; a new one takes name and file from the first source.
Collection begin_collection(const std::string& folder, const Provenance& first) {
  Collection collection;
  collection.folder = folder;
  if (file_exists(folder + "/provenance.json")) {
    collection.provenance = read_results(folder).provenance;
    JournalReading finished = finished_outcomes(folder);
    collection.outcomes = std::move(finished.outcomes);
    std::cerr << damage_warnings(folder, finished.damage);
  } else {
    collection.provenance = first;
    collection.provenance.runs.clear();
  }
  for (const JobFacts& job : collection.provenance.sweep.jobs) collection.jobs.insert(job.id);
  collection.provenance.build = {program_version(), compiler_version(), library_versions()};
  return collection;
}

void add_results(const std::string& folder, const Results& results, Journal& journal,
                 Collection& to) {
  add_name(results.provenance, to.provenance);
  add_sweep(results.provenance, to);
  add_runs(results.provenance.runs, to.provenance.runs);
  for (const Row& row : results.rows) {
    if (row.outcome) add_outcome(folder, *row.outcome, journal, to);
  }
}

/// All sources, read before anything is written: a wrong folder costs nothing.
std::vector<Results> read_sources(const CollectOptions& options) {
  std::vector<Results> sources;
  for (const std::string& folder : options.folders) {
    std::error_code not_there;
    if (std::filesystem::equivalent(folder, options.out, not_there)) {
      throw BadInput(folder + ": is the folder given with --out; name only the others");
    }
    sources.push_back(read_results(folder));
    std::cerr << damage_warnings(folder, sources.back().damage);
  }
  return sources;
}

}  // namespace

int collect(const CollectOptions& options) {
  const std::vector<Results> sources = read_sources(options);
  make_folder(options.out);
  const FolderLock lock(options.out);
  if (lock.is_held()) remove_half_written(options.out);
  Collection collection = begin_collection(options.out, sources.front().provenance);
  Journal journal(options.out);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    add_results(options.folders[i], sources[i], journal, collection);
  }
  const std::vector<Row> rows = join(collection.provenance.sweep, collection.outcomes);
  std::cerr << other_versions_warning(rows, program_version());
  write_tables(options.out, collection.provenance, rows);
  const auto pending = static_cast<std::size_t>(totals_of(rows).counts.pending);
  std::cout << collection.added << " packings added to " << options.out << ", which now holds "
            << rows.size() - pending << " of " << rows.size() << "\n";
  return exit_done;
}

}  // namespace grainsweep
