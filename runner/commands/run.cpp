// The command `run`: sweep, what is missing of it, packings, tables, report, exit code.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <CLI/App.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/results.hpp"
#include "runner/commands/shared_options.hpp"
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

/// A kill may come between the end of a packing and the end of its checkpoints.
void remove_finished_checkpoints(const RunningSweep& running) {
  std::set<std::string> jobs;
  for (const Row& row : running.rows) jobs.insert(row.job.id);
  for (const Job* job : running.pending) jobs.erase(job->id);
  remove_checkpoints_of(running.folder, jobs);
}

/// A packing that ended in an exception is always tried again.
bool is_to_be_made(const Row& row, bool retry_failed) {
  return !row.outcome || row.outcome->exception ||
         (retry_failed && row.outcome->result.status == PackingStatus::failed);
}

/// What is stored of the sweep, and what is still to be made. Appends to `damage`.
RunningSweep resume(const Sweep& sweep, const std::string& folder, bool retry_failed,
                    std::vector<std::string>& damage) {
  RunningSweep running{sweep, folder, rows_of(sweep), {}};
  JournalReading stored = read_journals(folder);
  take_outcomes(std::move(stored.outcomes), running.rows);
  const auto damaged_beds = load_curves(folder, running.rows);
  damage.insert(damage.end(), stored.damage.begin(), stored.damage.end());
  damage.insert(damage.end(), damaged_beds.begin(), damaged_beds.end());
  for (std::size_t i = 0; i < sweep.jobs.size(); ++i) {
    if (is_to_be_made(running.rows[i], retry_failed)) running.pending.push_back(&sweep.jobs[i]);
  }
  remove_finished_checkpoints(running);
  return running;
}

/// What was packed, from the disk: however many packings a run makes, it keeps none of them in
/// memory meanwhile. Returns what was left out, as in Results::damage.
std::vector<std::string> read_packed(RunningSweep& running) {
  JournalReading stored = read_journals(running.folder);
  std::map<std::string, Outcome> packed;
  for (const Job* job : running.pending) packed.insert(stored.outcomes.extract(job->id));
  take_outcomes(std::move(packed), running.rows);
  return load_curves(running.folder, running.rows);
}

Provenance provenance_of(const RunOptions& options, const RunningSweep& running,
                         std::vector<std::string>& damage) {
  Provenance provenance;
  provenance.build = this_build();
  provenance.sweeps = {{options.file, read_file(options.file)}};
  provenance.sweep_name = running.sweep.name;
  provenance.units = running.sweep.units;
  provenance.runs = recorded_runs(running.folder, damage);
  return provenance;
}

/// Packs between the two entries of the run's record: it is in provenance.json from its start.
Packed record_and_pack(RunningSweep& running, const RunOptions& options, Isa isa,
                       Provenance& provenance) {
  const double start = wall_seconds();
  const Limits limits{options.threads > 0 ? options.threads : usable_cores(),
                      memory_for_packings()};
  std::cerr << memory_warning(costs_of(running.pending), limits.memory);
  expect_threads(limits.threads);
  provenance.runs.push_back({utc_now(), "", 0.0, process_name(), limits.threads, name_of(isa), 0,
                             command_line(), host_name(), processor_name(), usable_cores(),
                             provenance.build.commit});
  write_provenance(running.folder, provenance, running.rows);
  RunRecord& record = provenance.runs.back();
  Packed packed = pack_pending(running, {limits, isa, progress_style(options.quiet),
                                         options.checkpoint_seconds, options.fail_fast});
  record.packings = packed.packings;
  record.wall_seconds = wall_seconds() - start;
  record.ended = utc_now();
  return packed;
}

/// The options to go on with: those of this run, but for what is done once.
std::string repeated(const RunOptions& options, const std::string& folder) {
  std::ostringstream text;
  text << shell_word(options.file) << " --out " << shell_word(folder);
  if (options.threads > 0) text << " --threads " << options.threads;
  if (!options.isa.empty()) text << " --isa " << options.isa;
  if (options.checkpoint_seconds != RunOptions{}.checkpoint_seconds) {
    text << " --checkpoint-seconds " << options.checkpoint_seconds;
  }
  if (options.retry_failed) text << " --retry-failed";
  if (options.fail_fast) text << " --fail-fast";
  if (options.quiet) text << " --quiet";
  if (options.no_report) text << " --no-report";
  return text.str();
}

/// Says why the run stopped before its end and how to go on; returns the exit code.
int stopped(const Packed& packed, const RunOptions& options, const std::string& folder,
            const StatusCounts& counts, std::size_t packings) {
  const bool by_signal = stop_signal() != 0;
  std::cerr << (by_signal ? "Stopped."
                          : "Stopped by --fail-fast after " + packed.first_failure + ".")
            << " " << packings - static_cast<std::size_t>(counts.pending) << " of " << packings
            << " packings are kept in " << folder;
  const std::size_t saved = saved_packings(folder);
  if (saved > 0) std::cerr << ", " << saved << " under way in its checkpoints";
  std::cerr << ".\nGo on with: " << called_as() << " run " << repeated(options, folder) << "\n";
  return by_signal ? exit_stopped + stop_signal() : static_cast<int>(exit_left_out);
}

/// Of a run that made all it had to. What is not there at its end was taken away meanwhile.
int exit_code_for(const StatusCounts& counts, const std::string& folder) {
  if (counts.pending > 0) {
    std::cerr << "warning: " << counts.pending << " packings are no longer in " << folder
              << ", though they were stored there; run the sweep again to make them anew\n";
  }
  return counts.pending + counts.failed + counts.not_settled > 0 ? exit_left_out : exit_done;
}

std::string presets_text() {
  std::string text = "Accuracy, a member of the sweep file:";
  for (const Preset& preset : presets()) {
    text += "\n  " + std::string(preset.name) + ": " + std::string(preset.promise);
  }
  return text;
}

}  // namespace

CLI::App& add_command(CLI::App& app, RunOptions& options) {
  CLI::App& run = *app.add_subcommand(
      "run", "Make the packings of a sweep, or what is missing of them, and the tables");
  add_file(run, options.file);
  run.add_option("--out", options.out, "output folder (default: out/<sweep name>)")
      ->type_name("DIR");
  add_threads(run, options.threads);
  run.add_option("--isa", options.isa,
                 "sse2, avx2 or avx512 (default: GRAINSWEEP_ISA, else the widest)")
      ->type_name("NAME");
  run.add_option("--checkpoint-seconds", options.checkpoint_seconds,
                 "save packings under way this often; stopping always saves them")
      ->check(CLI::Range(0.0, 86400.0))
      ->capture_default_str()
      ->type_name("S");
  run.add_flag("--fresh", options.fresh, "delete what is stored in the folder and start anew");
  run.add_flag("--yes", options.yes, "do not ask before --fresh deletes");
  run.add_flag("--retry-failed", options.retry_failed,
               "make failed packings again, for instance with a newer version");
  run.add_flag("--fail-fast", options.fail_fast,
               "stop at the first packing that fails; without it the others go on");
  run.add_flag("--quiet", options.quiet, "print warnings and errors only");
  run.add_flag("--no-report", options.no_report, "leave out the page report.html and its figures");
  run.footer("Example: grainsweep run configs/quick.json --out out/quick --threads 2\n\n" +
             presets_text() + "\n\n" + exit_codes_text);
  return run;
}

int perform(const RunOptions& options) {
  const Sweep sweep = sweep_or_refusal(options.file);
  const Isa isa = choose_isa(options.isa);
  const std::string folder = options.out.empty() ? "out/" + sweep.name : options.out;
  confirm_fresh(options, folder);
  make_folder(folder);
  const FolderLock lock(folder);
  clean_up(folder, lock);
  if (options.fresh) remove_results(folder);
  watch_stop_signals();

  std::vector<std::string> damage;
  RunningSweep running = resume(sweep, folder, options.retry_failed, damage);
  Provenance provenance = provenance_of(options, running, damage);
  std::cerr << damage_warnings(damage);
  Packed packed;
  if (!running.pending.empty()) {
    const std::size_t done = running.rows.size() - running.pending.size();
    if (done > 0 && !options.quiet) {
      std::cerr << done << " of " << running.rows.size() << " packings are done, going on\n";
    }
    packed = record_and_pack(running, options, isa, provenance);
    std::cerr << damage_warnings(read_packed(running));
  }

  const std::vector<Row>& rows = running.rows;
  const StatusCounts counts = totals_of(rows).counts;
  std::cerr << other_versions_warning(rows, program_version());
  const Analysis analysis = analyse(rows);
  write_tables(folder, provenance, rows, analysis);
  const bool is_whole = static_cast<std::size_t>(packed.packings) == running.pending.size();
  if (is_whole && !options.quiet) {
    std::cout << closing_report(provenance, rows, analysis.families, {called_as(), folder})
              << std::flush;
  }
  if (!options.no_report) {
    const PageExtent extent = stop_signal() != 0 ? PageExtent::text : PageExtent::whole;
    const std::string where = write_page(folder, provenance, rows, analysis, extent);
    if (is_whole && !options.quiet) std::cout << where;
  } else if (packed.packings > 0 && file_exists(folder + "/report.html")) {
    std::cerr << "note: " << folder << "/report.html is of an earlier run; " << called_as()
              << " report " << shell_word(folder) << " writes it anew\n";
  }
  return is_whole ? exit_code_for(counts, folder)
                  : stopped(packed, options, folder, counts, rows.size());
}

}  // namespace grainsweep
