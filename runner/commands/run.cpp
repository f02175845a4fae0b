// The command `run`: sweep, what is missing of it, packings, tables, report, exit code.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string_view>
#include <unistd.h>
#include <utility>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/instruction_set.hpp"
#include "runner/jobs/pack_pending.hpp"
#include "runner/jobs/stop.hpp"
#include "runner/machine.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/lock.hpp"
#include "runner/tables/closing_report.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::quiet;
  const char* terminal = std::getenv("TERM");
  const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
  return isatty(STDERR_FILENO) != 0 && can_redraw ? ProgressStyle::live : ProgressStyle::plain;
}

/// Asks before stored packings are forgotten. Throws BadInput unless that is wanted.
void confirm_fresh(const RunOptions& options, const std::string& folder) {
  if (!options.fresh || options.yes) return;
  const std::size_t count = stored_packings(folder);
  if (count == 0) return;
  const std::string what = std::to_string(count) + " stored packings in " + folder;
  if (isatty(STDIN_FILENO) == 0) {
    throw BadInput("--fresh would delete " + what + "; add --yes to confirm");
  }
  std::cerr << "Delete " << what << " and start anew? [y/N] " << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "y" && answer != "yes") throw BadInput("nothing was deleted, nothing was run");
}

/// Each once: what is found at the beginning is found at the end again.
void warn_once(const std::string& folder, const std::vector<std::string>& damage,
               std::set<std::string>& warned) {
  for (const std::string& line : damage) {
    if (warned.insert(line).second) std::cerr << damage_warnings(folder, {line});
  }
}

/// A kill may come between the end of a packing and the end of its checkpoints.
void remove_finished_checkpoints(const std::string& folder,
                                 const std::map<std::string, Outcome>& finished) {
  std::set<std::string> jobs;
  for (const auto& [job, outcome] : finished) jobs.insert(job);
  remove_checkpoints_of(folder, jobs);
}

/// What is stored of the sweep, and what is still to be made.
RunningSweep resume(const Sweep& sweep, const std::string& folder, bool retry_failed,
                    std::set<std::string>& warned) {
  JournalReading stored = finished_outcomes(folder);
  warn_once(folder, stored.damage, warned);
  RunningSweep running{sweep, folder, std::move(stored.outcomes), {}};
  remove_finished_checkpoints(folder, running.outcomes);
  if (retry_failed) {
    std::erase_if(running.outcomes, [](const auto& entry) {
      return entry.second.result.status == PackingStatus::failed;
    });
  }
  for (const Job& job : sweep.jobs) {
    if (!running.outcomes.contains(job.id)) running.pending.push_back(&job);
  }
  return running;
}

Provenance provenance_of(const RunOptions& options, const RunningSweep& running) {
  Provenance provenance;
  provenance.build = {program_version(), compiler_version(), library_versions()};
  provenance.sweep_file = options.file;
  provenance.sweep_text_hash = text_hash(read_file(options.file));
  provenance.sweep = facts_of(running.sweep);
  provenance.runs = recorded_runs(running.folder);
  return provenance;
}

/// Packs between the two entries of the run's record: it is in provenance.json from its start.
Packed record_and_pack(const RunningSweep& running, const RunOptions& options, Isa isa,
                       Provenance& provenance) {
  const double start = wall_seconds();
  const Limits limits{options.threads > 0 ? options.threads : usable_cores(),
                      memory_for_packings()};
  std::cerr << memory_warning(tasks_of(running.pending), limits.memory);
  provenance.runs.push_back({utc_now(), "", 0.0, process_name(), limits.threads, name_of(isa), 0});
  write_provenance(running.folder, provenance, join(provenance.sweep, running.outcomes));
  RunRecord& record = provenance.runs.back();
  Packed packed = pack_pending(running, {limits, isa, progress_style(options.quiet),
                                         options.checkpoint_seconds, options.fail_fast});
  record.packings = packed.packings;
  record.wall_seconds = wall_seconds() - start;
  record.ended = utc_now();
  return packed;
}

/// Says why the run stopped before its end and how to go on; returns the exit code.
int stopped(const Packed& packed, const RunOptions& options, const std::string& folder,
            const StatusCounts& counts, std::size_t packings) {
  const bool by_signal = stop_signal() != 0;
  std::cerr << (by_signal ? "Stopped."
                          : "Stopped by --fail-fast after " + packed.first_failure + ".")
            << " " << packings - static_cast<std::size_t>(counts.pending) << " of " << packings
            << " packings are kept in " << folder << ".\nGo on with: grainsweep run "
            << shell_word(options.file) << " --out " << shell_word(folder) << "\n";
  return by_signal ? exit_stopped + stop_signal() : static_cast<int>(exit_left_out);
}

int exit_code_for(const StatusCounts& counts) {
  return counts.failed + counts.not_settled > 0 ? exit_left_out : exit_done;
}

}  // namespace

int run(const RunOptions& options) {
  const Sweep sweep = sweep_or_refusal(options.file);
  const Isa isa = choose_isa(options.isa);
  const std::string folder = options.out.empty() ? "out/" + sweep.name : options.out;
  confirm_fresh(options, folder);
  make_folder(folder);
  const FolderLock lock(folder);
  if (lock.is_held()) remove_half_written(folder);
  if (options.fresh) remove_results(folder);
  watch_stop_signals();

  std::set<std::string> warned;
  const RunningSweep running = resume(sweep, folder, options.retry_failed, warned);
  Provenance provenance = provenance_of(options, running);
  Packed packed;
  if (!running.pending.empty()) packed = record_and_pack(running, options, isa, provenance);

  const JournalReading stored = stored_outcomes(folder);
  warn_once(folder, stored.damage, warned);
  const std::vector<Row> rows = join(provenance.sweep, stored.outcomes);
  const StatusCounts counts = totals_of(rows).counts;
  std::cerr << other_versions_warning(rows, program_version());
  write_tables(folder, provenance, rows);
  const bool is_whole = static_cast<std::size_t>(packed.packings) == running.pending.size();
  if (!is_whole) return stopped(packed, options, folder, counts, rows.size());
  if (!options.quiet) std::cout << closing_report(provenance, rows, folder);
  return exit_code_for(counts);
}

}  // namespace grainsweep
