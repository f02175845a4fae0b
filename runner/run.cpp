// The command `run`: sweep, what is missing of it, packings, tables, report, exit code.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <unistd.h>

#include "runner/commands.hpp"
#include "runner/exit_codes.hpp"
#include "runner/instruction_set.hpp"
#include "runner/machine.hpp"
#include "runner/progress.hpp"
#include "runner/report.hpp"
#include "runner/results.hpp"
#include "runner/schedule.hpp"
#include "runner/stop.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/states.hpp"
#include "runner/tables/csv.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

/// Share of the available memory that live packings may take together.
constexpr double memory_share = 0.8;

/// A run under way.
struct RunningSweep {
  const Sweep& sweep;
  std::string folder;
  std::map<std::string, Outcome> outcomes;  ///< finished ones, by job
  std::vector<const Job*> pending;
};

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

void warn_about(const std::string& folder, const std::vector<std::string>& damage) {
  for (const std::string& line : damage) std::cerr << "warning: " << folder << "/" << line << "\n";
}

RunningSweep resume(const Sweep& sweep, const std::string& folder) {
  const JournalReading journals = read_journals(folder);
  warn_about(folder, journals.damage);
  RunningSweep running{sweep, folder, finished_outcomes(folder, journals.outcomes), {}};
  for (const Job& job : sweep.jobs) {
    if (!running.outcomes.contains(job.id)) running.pending.push_back(&job);
  }
  return running;
}

std::string packing_line(const Job& job, const Outcome& outcome) {
  const PackingResult& result = outcome.result;
  std::string text = job.label + " W=" + cell(job.spec.box.width) +
                     (job.spec.box.y == Boundary::walls ? "" : " periodic") + " #" +
                     std::to_string(job.replicate) + "  " + name_of(result.status);
  if (!result.reason.empty()) text += " (" + result.reason + ")";
  if (!result.coordination.empty()) {
    text += "  φ " + fixed(result.solid_fraction, 4) + "  Z " +
            fixed(result.coordination.front().between_grains, 3);
  }
  return text + "  " + duration_text(outcome.cpu_seconds);
}

/// Puts a finished packing on the disk, grains first: a journal line promises that they are there.
Outcome store(const Job& job, const std::string& folder, Journal& journal, Finished&& finished) {
  Outcome outcome;
  outcome.job = job.id;
  outcome.version = program_version();
  outcome.result = std::move(finished.packing.result);
  outcome.threw = finished.threw;
  outcome.stored_grains = static_cast<std::int64_t>(finished.packing.grains.size());
  outcome.cpu_seconds = finished.cpu_seconds;
  if (outcome.stored_grains > 0) {
    write_bed(folder, job.id, {job.spec.box, std::move(finished.packing.grains)});
  }
  journal.append(outcome);
  return outcome;
}

std::vector<Task> tasks_of(const std::vector<const Job*>& jobs) {
  std::vector<Task> tasks;
  tasks.reserve(jobs.size());
  for (const Job* job : jobs) tasks.push_back({&job->spec, estimate_cost(job->spec)});
  return tasks;
}

std::vector<double> cpu_costs(const std::vector<Task>& tasks) {
  std::vector<double> costs;
  costs.reserve(tasks.size());
  for (const Task& task : tasks) costs.push_back(task.cost.cpu_seconds);
  return costs;
}

/// Makes the pending packings, as far as no signal stops it. Returns how many were finished.
int pack_pending(RunningSweep& running, const Limits& limits, Isa isa, ProgressStyle style) {
  const std::vector<Task> tasks = tasks_of(running.pending);
  ProgressDisplay display(cpu_costs(tasks), style, stderr);
  Journal journal(running.folder);
  int count = 0;
  TaskEvents events;
  events.started = [&](std::size_t task) { display.start(task); };
  events.progressed = [&](std::size_t task, const Progress& progress) {
    display.advance(task, progress.share_done);
  };
  events.finished = [&](Finished&& finished) {
    const std::size_t task = finished.task;
    const Job& job = *running.pending[task];
    const Outcome outcome = store(job, running.folder, journal, std::move(finished));
    running.outcomes[job.id] = outcome;
    ++count;
    const bool is_settled = outcome.result.status == PackingStatus::settled;
    display.finish(task, is_settled, packing_line(job, outcome));
  };
  events.stop_asked = [] { return stop_signal() != 0; };
  const Kernels& kernels = kernels_for(isa);
  const Pack pack = [&](const PackingSpec& spec, const KeepGoing& keep_going) {
    return make_packing(spec, kernels, keep_going);
  };
  run_tasks(tasks, limits, pack, events);
  display.clear();
  return count;
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
void record_and_pack(RunningSweep& running, const RunOptions& options, Isa isa,
                     Provenance& provenance) {
  const double start = wall_seconds();
  const Limits limits{options.threads > 0 ? options.threads : usable_cores(),
                      memory_share * available_memory()};
  provenance.runs.push_back({utc_now(), "", 0.0, process_name(), limits.threads, name_of(isa), 0});
  write_provenance(running.folder, provenance, join(provenance.sweep, running.outcomes));
  RunRecord& record = provenance.runs.back();
  record.packings = pack_pending(running, limits, isa, progress_style(options.quiet));
  record.wall_seconds = wall_seconds() - start;
  record.ended = utc_now();
}

void say_how_to_go_on(const RunOptions& options, const std::string& folder,
                      const StatusCounts& counts, std::size_t packings) {
  std::cerr << "Stopped. " << packings - static_cast<std::size_t>(counts.pending) << " of "
            << packings << " packings are kept in " << folder << ".\nGo on with: grainsweep run "
            << options.file << " --out " << folder << "\n";
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
  if (options.fresh) remove_results(folder);
  watch_stop_signals();

  RunningSweep running = resume(sweep, folder);
  Provenance provenance = provenance_of(options, running);
  if (!running.pending.empty()) record_and_pack(running, options, isa, provenance);

  const std::vector<Row> rows = join(provenance.sweep, running.outcomes);
  const StatusCounts counts = totals_of(rows).counts;
  std::cerr << other_versions_warning(rows, program_version());
  write_tables(folder, provenance, rows);
  if (counts.pending > 0 && stop_signal() != 0) {
    say_how_to_go_on(options, folder, counts, rows.size());
    return exit_stopped + stop_signal();
  }
  if (!options.quiet) std::cout << closing_report(provenance, rows, folder);
  return exit_code_for(counts);
}

}  // namespace grainsweep
