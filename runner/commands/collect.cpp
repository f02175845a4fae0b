// The command `collect`: the results of several output folders in one.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/hash.hpp"
#include "runner/jobs/progress.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/store/shard.hpp"
#include "runner/store/shard_files.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

/// Packings that are added before they are written to the disk together.
constexpr std::size_t added_at_once = 1000;

/// What becomes of packings whose beds cannot be read.
constexpr std::string_view left_out = "left out";

/// The merged folder while it grows.
struct Collection {
  std::string folder;
  ShardFiles& files;
  ProgressDisplay& display;
  Provenance provenance;
  std::vector<Row> rows;
  std::map<std::string, std::size_t> row_of;  ///< by job
  /// The first row of each set of parameters, by their text, which the rows keep.
  std::map<std::string_view, std::size_t> row_with;
  /// Beds of given starts, by their parameters and state: whatever the seed, they come out alike.
  std::set<std::pair<std::string, std::uint64_t>> of_starts;
  /// Content of the files that parameters were read from, by parameter and name of the file.
  std::map<std::pair<std::string, std::string>, std::string> content_of;
  /// What is stored of other forms of the sweeps, which is in no table.
  Outcomes others;
  std::size_t added = 0, given_grains = 0, stored = 0;
  std::vector<BedFault> faults = {};  ///< of beds of the present source, which are left out
  bool is_current_only = false;       ///< nothing is kept of other forms of a sweep
  bool is_short = false;              ///< something stored could not be read
};

/// The record of this process; it makes no packing, and is not listed among the runs.
RunRecord begun_collection() {
  RunRecord run;
  run.started = utc_now();
  run.process = process_name();
  run.host = host_name();
  run.command = command_line();
  return run;
}

/// The line of progress is drawn anew below.
void warn(const std::string& text, Collection& to) {
  to.display.clear();
  std::cerr << "warning: " << text << "\n";
}

void warn_of(const std::vector<std::string>& damage, Collection& to) {
  for (const std::string& line : damage) warn(line, to), to.is_short = true;
}

/// Packings of equal parameters are one group: they get the label of the first. Adds one that is so
/// renamed to `renamed`, "its label" -> "the first one's".
void add_row(Row&& row, Collection& to, std::map<std::string, std::string>& renamed) {
  const auto [first, is_new] = to.row_with.try_emplace(row.job.parameters.text(), to.rows.size());
  if (!is_new && to.rows[first->second].job.label != row.job.label) {
    const std::string& label = to.rows[first->second].job.label;
    renamed[std::exchange(row.job.label, label)] = label;
  }
  to.rows.push_back(std::move(row));
}

/// Files of one name but different content, from different folders, are told apart by a hash.
void tell_files_apart(JobFacts& job, Collection& to) {
  if (job.files.empty()) return;
  const auto contents = identifying_parameters(job);
  for (auto& [path, file] : job.files) {
    const auto content = contents.find(path);
    const bool is_of_all = content != contents.end() && path != "fill.files";  // each has its own
    if (!is_of_all) continue;
    const auto [known, is_new] = to.content_of.try_emplace({path, file}, content->second);
    if (is_new || known->second == content->second) continue;
    file += " " + hex16(fnv1a(content->second)).substr(0, 8);
    to.content_of[{path, file}] = content->second;
  }
}

/// The row of a job; a new, pending one if there is none yet.
Row& row_of(const JobEntry& job, const JobList& list, Collection& to,
            std::map<std::string, std::string>& renamed) {
  const auto [known, is_new] = to.row_of.try_emplace(job.id, to.rows.size());
  if (is_new) {
    Row row{facts_of(job, list), std::nullopt};
    tell_files_apart(row.job, to);
    add_row(std::move(row), to, renamed);
  }
  return to.rows[known->second];
}

bool has_given_start(const JobFacts& job) {
  return job.files.contains("fill.file") || job.files.contains("fill.files");
}

/// Whether a bed that is kept has the given start of this one, and came out alike: with another
/// seed it is no other packing.
bool is_kept_start(const Row& row, const Outcome& outcome, const Collection& to) {
  return has_given_start(row.job) && !outcome.exception &&
         to.of_starts.contains({row.job.parameters.text(), outcome.result.state_hash});
}
/// Notes the bed of a given start, if it is kept.
void note_start(const Row& row, Collection& to) {
  if (!has_given_start(row.job) || !is_made(row)) return;
  to.of_starts.emplace(row.job.parameters.text(), row.outcome->result.state_hash);
}

void add_runs(const std::vector<RunRecord>& from, Collection& to) {
  std::vector<RunRecord>& runs = to.provenance.runs;
  for (const RunRecord& run : from) {
    const auto is_this = [&](const RunRecord& known) { return is_same_run(known, run); };
    if (std::any_of(runs.begin(), runs.end(), is_this)) continue;
    runs.push_back(run);
    to.files.add(run);
  }
}

/// Name and file of a sweep, each once.
void add_sweep(const Provenance& from, Provenance& to) {
  const std::string names = "+" + to.sweep_name + "+";
  if (names.find("+" + from.sweep_name + "+") == std::string::npos) {
    to.sweep_name += "+" + from.sweep_name;
  }
  for (const SweepFile& sweep : from.sweeps) {
    const bool is_known =
        std::any_of(to.sweeps.begin(), to.sweeps.end(),
                    [&](const SweepFile& known) { return known.text == sweep.text; });
    if (!is_known) to.sweeps.push_back(sweep);
  }
}

/// Units hold for all packings of a folder.
void add_units(const std::string& folder, const GivenUnits& from, Collection& to) {
  if (from == to.provenance.units) return;
  warn(folder + ": has other units than the sweeps before it; the tables have none", to);
  to.provenance.units.reset();
}

bool is_same_result(const Outcome& a, const Outcome& b) {
  return a.result.state_hash == b.result.state_hash && a.result.status == b.result.status;
}

/// Copies the bed of a stored packing; false, and a warning later, if it is missing or damaged.
bool copy_bed(const std::string& folder, Outcome& outcome, Collection& to) {
  try {
    to.files.add_bed(read_bed(folder, outcome), outcome);
    return true;
  } catch (const FileError& error) {
    to.faults.push_back(fault_of_bed(outcome.job, error));
    return false;
  }
}

/// Whether both have the same bed, and `known` was stored without its grains.
bool brings_grains(const Outcome& outcome, const Outcome& known) {
  return is_same_result(outcome, known) && outcome.stored_bytes > known.stored_bytes;
}

/// Stores an outcome and its bed, so that it counts more than the `known` one, which it replaces;
/// false, and a warning later, if the bed is missing or damaged.
bool store(const std::string& folder, Boxed<Outcome>&& outcome, Boxed<Outcome>& known,
           Collection& to) {
  if (outcome->stored_bytes > 0 && !copy_bed(folder, *outcome, to)) return false;
  if (known) to.files.count_after(*known);
  *outcome = to.files.add(std::move(*outcome));
  known = std::move(outcome);
  return true;
}

/// "3 packings added", and grains of those that had been stored without.
std::string added_text(std::size_t added, std::size_t given_grains) {
  const std::string text = counted(added, "packing");
  return (given_grains > 0 ? text + " and the grains of " + std::to_string(given_grains) : text) +
         " added";
}

void add_outcome(const std::string& folder, Boxed<Outcome> outcome, Row& row, Collection& to) {
  const bool is_known = is_made(row);
  if (is_known && !brings_grains(*outcome, *row.outcome)) {
    if (!outcome->exception && !is_same_result(*outcome, *row.outcome)) {
      warn(folder + ": its packing " + outcome->job + " (version " + outcome->version +
               ") differs from the one collected before (version " + row.outcome->version +
               "), which is kept",
           to);
    }
    return;
  }
  if (!store(folder, std::move(outcome), row.outcome, to)) return;
  ++(is_known ? to.given_grains : to.added);
  if (++to.stored % added_at_once == 0) to.files.flush();
}

/// Keeps what a folder holds besides its sweep: packings of other forms of it, which may come
/// again.
void add_others(const std::string& folder, Outcomes&& outcomes, Collection& to) {
  std::size_t kept = 0, left = 0;
  for (auto& [job, outcome] : outcomes) {
    if (const auto row = to.row_of.find(job); row != to.row_of.end()) {
      add_outcome(folder, std::move(outcome), to.rows[row->second], to);
      continue;
    }
    left += to.is_current_only ? 1 : 0;
    if (outcome->exception || to.is_current_only) continue;
    Boxed<Outcome>& known = to.others[job];  // nothing, if it is new
    const bool is_better = !known || known->exception || brings_grains(*outcome, *known);
    kept += is_better && store(folder, std::move(outcome), known, to) ? 1 : 0;
  }
  if (left > 0) {
    to.display.clear();
    std::cerr << "note: " << folder << ": " << counted(left, "packing")
              << " of another form of its sweep left out\n";
  }
  if (kept == 0) return;
  warn(folder + ": " + counted(kept, "packing") +
           " of another form of its sweep: kept for a run of that, but in no table; --current "
           "leaves them out",
       to);
}

/// What the folder holds already; a new one takes name and file from the first source.
Collection begin_collection(const std::string& folder, ShardFiles& files, ProgressDisplay& display,
                            const RunRecord& own, const Provenance& first) {
  Collection collection{folder, files, display, first, {}, {}, {}, {}, {}, {}};
  collection.provenance.runs.clear();
  if (file_exists(provenance_path(folder))) {
    StoredSweep stored = read_stored_sweep(folder);
    warn_of(stored.damage, collection);
    collection.rows = rows_of(stored.jobs);
    for (Row& row : collection.rows) {
      if (auto known = stored.outcomes.extract(row.job.id)) row.outcome = std::move(known.mapped());
      if (row.outcome) files.count_after(*row.outcome);
    }
    warn_of(check_beds(folder, collection.rows), collection);
    collection.others = std::move(stored.outcomes);
    std::vector<BedFault> faults;
    std::erase_if(collection.others,
                  [&](const auto& other) { return !has_sound_bed(folder, *other.second, faults); });
    warn_of(lines_of(faults, left_out), collection);
    collection.provenance = std::move(stored.provenance);
    std::erase_if(collection.provenance.runs,
                  [&](const RunRecord& run) { return is_same_run(run, own); });
  }
  for (std::size_t i = 0; i < collection.rows.size(); ++i) {
    tell_files_apart(collection.rows[i].job, collection);
    collection.row_of[collection.rows[i].job.id] = i;
    collection.row_with.try_emplace(collection.rows[i].job.parameters.text(), i);
    note_start(collection.rows[i], collection);
  }
  collection.provenance.build = this_build();
  return collection;
}

/// Adds what the folder holds, a packing at a time; `tell` gets how much of it is done, 0..1.
void add_results(const std::string& folder, StoredSweep&& stored, Collection& to,
                 const std::function<void(double)>& tell) {
  add_sweep(stored.provenance, to.provenance);
  add_units(folder, stored.provenance.units, to);
  add_runs(stored.provenance.runs, to);
  const double all = static_cast<double>(std::max<std::size_t>(stored.outcomes.size(), 1));
  if (to.rows.empty()) to.rows.reserve(stored.jobs.jobs.size());
  std::map<std::string, std::string> renamed;
  std::size_t copies = 0;
  for (const JobEntry& job : stored.jobs.jobs) {
    const std::size_t rows_before = to.rows.size();
    Row& row = row_of(job, stored.jobs, to, renamed);
    if (auto other = to.others.extract(job.id); other && !row.outcome) {
      row.outcome = std::move(other.mapped());
    }
    auto outcome = stored.outcomes.extract(job.id);
    if (!outcome) continue;
    const bool is_new = rows_before < to.rows.size();
    if (is_new && is_kept_start(row, *outcome.mapped(), to)) {
      to.row_of.erase(job.id);
      to.rows.pop_back();
      ++copies;
      continue;
    }
    add_outcome(folder, std::move(outcome.mapped()), row, to);
    note_start(row, to);
    tell(1.0 - static_cast<double>(stored.outcomes.size()) / all);
  }
  add_others(folder, std::move(stored.outcomes), to);
  if (copies > 0) {
    warn(folder + ": " + counted(copies, "packing") +
             " of a given start that is collected already, with another seed: the bed is the same, "
             "and is kept once",
         to);
  }
  for (const auto& [label, first] : renamed) {
    warn(folder + ": packings called \"" + label + "\" have the parameters of \"" + first +
             "\" collected before, and are called so, too",
         to);
  }
}

/// A wrong folder is refused before anything is written.
void expect_sources(const CollectOptions& options) {
  for (const std::string& folder : options.folders) {
    std::error_code not_there;
    if (std::filesystem::equivalent(folder, options.out, not_there)) {
      throw BadInput(folder + ": is the folder given with --out; name only the others");
    }
    expect_results(folder);
  }
}

/// Bytes of the journals of each folder: the cost of reading it.
std::vector<double> sizes_of(const std::vector<std::string>& folders) {
  std::vector<double> sizes;
  for (const std::string& folder : folders) {
    double& bytes = sizes.emplace_back(0.0);
    for (const std::string& shard : shards_in(folder)) {
      bytes += static_cast<double>(file_size(journal_path(folder, shard)).value_or(0));
    }
  }
  return sizes;
}

/// One folder after the other, so that the packings of no two are in memory at once.
Collection collected(const CollectOptions& options, ShardFiles& files, ProgressDisplay& display,
                     const RunRecord& own) {
  std::optional<Collection> collection;
  for (std::size_t i = 0; i < options.folders.size(); ++i) {
    const std::string& folder = options.folders[i];
    display.start();
    StoredSweep stored = read_stored_sweep(folder);
    if (!collection) {
      collection.emplace(begin_collection(options.out, files, display, own, stored.provenance));
      collection->is_current_only = options.current;
    }
    warn_of(stored.damage, *collection);
    const std::size_t before = collection->added, given_before = collection->given_grains;
    add_results(folder, std::move(stored), *collection,
                [&](double share) { display.advance(i, share); });
    warn_of(lines_of(std::exchange(collection->faults, {}), left_out), *collection);
    // A collection that is killed later goes on from here.
    files.flush();
    record_sweep(options.out, collection->provenance, collection->rows);
    display.finish(
        i, true,
        folder + ": " +
            added_text(collection->added - before, collection->given_grains - given_before));
  }
  display.clear();
  return std::move(*collection);
}

}  // namespace

void add_command(CLI::App& app, CollectOptions& options) {
  CLI::App& collect =
      *app.add_subcommand("collect", "Merge the results of several output folders into one");
  collect.add_option("DIR", options.folders, "output folders")->required()->type_name("");
  collect.add_option("--out", options.out, "folder to merge into; what it holds stays")
      ->required()
      ->check(not_empty())
      ->type_name("DIR");
  collect.add_flag("--current", options.current,
                   "leave out packings of other forms of the sweeps, which are in no table");
  collect.footer("Example: grainsweep collect out/node1 out/node2 --out out/all");
}

int perform(const CollectOptions& options) {
  expect_sources(options);
  expect_no_foreign_files(options.out);
  make_folder(options.out);
  RunRecord run = begun_collection();
  ShardFiles files(options.out, {}, run);
  warn_without_lock(options.out, files);
  if (files.is_locked()) clean_up(options.out);
  ProgressDisplay display(sizes_of(options.folders), progress_style(), stderr);
  Collection collection = collected(options, files, display, run);
  run.ended = utc_now();
  files.add(run);
  files.flush();
  sort_runs(collection.provenance.runs);
  collection.row_of.clear();
  const std::vector<Row>& rows = collection.rows;
  std::cerr << other_versions_warning(rows, program_version());
  const Analysis analysis = analyse(rows, options.out);
  write_tables(options.out, collection.provenance, rows, analysis);
  const auto pending = static_cast<std::size_t>(totals_of(rows).counts.pending);
  std::cout << added_text(collection.added, collection.given_grains) << " to " << options.out
            << ", which now holds " << rows.size() - pending << " of " << rows.size() << "\n"
            << std::flush;
  std::cout << write_page(options.out, collection.provenance, rows, analysis);
  return collection.is_short ? exit_file_system : exit_done;
}

}  // namespace grainsweep
