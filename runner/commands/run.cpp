// The command `run`: sweep, its missing packings, making them, tables, report, exit code.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <set>
#include <unistd.h>
#include <unordered_set>
#include <utility>

#include <CLI/App.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/results.hpp"
#include "runner/commands/shard_option.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/hash.hpp"
#include "runner/instruction_set.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/jobs/helping.hpp"
#include "runner/jobs/pack_pending.hpp"
#include "runner/jobs/stop.hpp"
#include "runner/jobs/sweep_parts.hpp"
#include "runner/machine.hpp"
#include "runner/store/checkpoints.hpp"
#include "runner/store/files.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/runners.hpp"
#include "runner/store/shard_files.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/tables/closing_report.hpp"
#include "runner/tables/packing_names.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

/// Asks before stored packings are forgotten. Throws BadInput unless the user wants that.
void confirm_fresh(const RunOptions& options, const std::string& folder, const Shard& shard) {
  if (!options.fresh) return;
  if (shard.count > 1) {
    throw BadInput("--fresh would delete what other shards have made; use it without --shard");
  }
  if (options.yes) return;
  const std::string stored = stored_packings(folder);
  if (stored.empty()) return;
  const std::string what = stored + " in " + folder;
  if (isatty(STDIN_FILENO) == 0) {
    throw BadInput("--fresh would delete " + what + "; add --yes to confirm");
  }
  std::cerr << "Delete " << what << " and start anew? [y/N] " << std::flush;
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "y" && answer != "yes") throw BadInput("nothing was deleted, nothing was run");
}

/// Refuses what must not go on in the folder. `form`: of the sweep, as in RunRecord. Throws
/// BadInput at files of others, FolderBusy where a runner makes another form of the sweep: shards
/// of two forms would make half of each. Whether one works on this shard its lock tells.
void expect_fitting_folder(const std::string& folder, const Shard& shard, const std::string& form) {
  expect_no_foreign_files(folder);
  for (const Runner& runner : runners_at_work(folder)) {
    const bool is_told = !runner.run.form.empty() && runner.run.ended.empty();
    const bool is_of_others = shard_from_name(runner.shard) != shard;
    if (!is_told || !is_of_others || runner.run.form == form) continue;
    throw FolderBusy(folder + ": another runner makes another form of this sweep here (" +
                     owner_text(runner.run) +
                     "), so that it was changed since; wait for it or give another folder with "
                     "--out");
  }
}

/// Hash of the packings of a sweep, and of its text where that says which of them are made.
std::string form_of(const Sweep& whole, const std::string& text) {
  std::uint64_t hash = fnv1a(grows(whole) ? text : "");
  for (const Job& job : whole.jobs) hash = fnv1a(job.id, hash);
  return hex16(hash);
}

/// The jobs of a shard, or those that were asked for. Throws BadInput.
std::set<std::string> jobs_of(const Shard& shard, const Sweep& whole,
                              const std::vector<std::string>& asked) {
  std::set<std::string> jobs;
  if (!asked.empty()) {
    std::vector<std::string> ids;
    ids.reserve(whole.jobs.size());
    for (const Job& job : whole.jobs) ids.push_back(job.id);
    for (const std::string& job : asked) {
      jobs.insert(ids[place_of_job(job, ids, "packings.csv or in plan --json")]);
    }
    return jobs;
  }
  const std::vector<int> shard_of = shards_of(whole, shard.count);
  for (std::size_t i = 0; i < shard_of.size(); ++i) {
    if (shard_of[i] == shard.number) jobs.insert(whole.jobs[i].id);
  }
  return jobs;
}

/// Those of `jobs` that belong to a sweep, by their places in it.
std::vector<std::size_t> places_of(const std::set<std::string>& jobs, const Sweep& sweep) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < sweep.jobs.size(); ++i) {
    if (jobs.contains(sweep.jobs[i].id)) places.push_back(i);
  }
  return places;
}

/// What a growing sweep has to look at; nothing for other sweeps.
Outcomes made_for_growth(const std::string& folder, const Sweep& whole) {
  return grows(whole) ? read_journals(folder, Detail::whole).outcomes : Outcomes();
}

/// Which stored packings are made again, besides those that ended in an exception.
struct Again {
  bool failed = false, without_grains = false;
};

bool is_to_be_made(const Outcome& outcome, const Again& again) {
  return outcome.exception || (again.without_grains && lacks_grains(outcome)) ||
         (again.failed && outcome.result.status == PackingStatus::failed);
}

/// The damage that this runner is to mend: all, or what its own journal has lost.
void keep_own(std::vector<std::string>& damage, const Shard& shard, const std::string& path) {
  if (shard.count == 1) return;
  std::erase_if(damage, [&](const std::string& line) { return !line.starts_with(path + ":"); });
}

/// What is still to be made of a shard. A kill may come between the end of a packing and the end of
/// its checkpoints: they are then removed. Warns of damage. With a signal to stop it ends at once,
/// at a packing that may have been made.
RunningSweep resume(const Sweep& sweep, const std::vector<std::size_t>& places, const Shard& shard,
                    const std::string& folder, ShardFiles& files, const Again& again) {
  RunningSweep running{folder, files, 0, {}, {}};
  if (shard.count > 1) running.claims = claims_in(folder);
  // Read whole, as the tables will: a packing whose line they could not read is made again.
  JournalReading stored = read_journals(folder, Detail::whole);
  keep_own(stored.damage, shard, journal_path(folder, files.name()));
  const std::vector<Cost> costs = costs_of(sweep.jobs);
  std::set<std::string> done;
  std::vector<BedFault> faults;
  for (const std::size_t place : places) {
    const Job& job = sweep.jobs[place];
    if (stop_signal() != 0) {  // the rest is neither looked at nor made
      running.pending.push_back(&job);
      return running;
    }
    const auto known = stored.outcomes.find(job.id);
    const bool is_done = known != stored.outcomes.end() && !is_to_be_made(*known->second, again) &&
                         has_sound_bed(folder, *known->second, faults);
    if (is_done) {
      done.insert(job.id);
      running.estimates.add(costs[place].cpu_seconds, known->second->cpu_seconds);
    } else {
      running.pending.push_back(&job);
      if (known != stored.outcomes.end()) files.count_after(*known->second);
    }
  }
  running.done = done.size();
  running.beds = known_beds(folder, stored.outcomes, running.pending);
  std::cerr << damage_warnings(remove_checkpoints_of(folder, done));
  if (!running.pending.empty()) {
    std::cerr << damage_warnings(stored.damage)
              << damage_warnings(lines_of(faults, "made anew now"));
  }
  return running;
}

/// Leaves out packings whose bed is that of one before them: it is packed once, and then known.
/// Returns whether there are any.
bool put_off_others_of_a_bed(RunningSweep& running) {
  std::unordered_set<std::uint64_t> beds;
  return std::erase_if(running.pending, [&](const Job* job) {
           return !running.beds.contains(job->id) && !beds.insert(job->settled_bed).second;
         }) > 0;
}

Provenance provenance_of(const RunOptions& options, const Sweep& sweep) {
  Provenance provenance;
  provenance.build = this_build();
  std::error_code unknown;
  provenance.sweeps = {
      {options.file, read_file(options.file), std::filesystem::current_path(unknown).string()}};
  provenance.sweep_name = sweep.name;
  provenance.units = sweep.units;
  return provenance;
}

/// The record of a run that begins now. `form`: of its sweep.
RunRecord begun_run(const RunOptions& options, Isa isa, const std::string& form) {
  const int threads = options.threads > 0 ? options.threads : usable_cores();
  return {utc_now(),
          "",
          0.0,
          process_name(),
          threads,
          name_of(isa),
          0,
          command_line(),
          host_name(),
          processor_name(),
          usable_cores(),
          source_commit(),
          form};
}

/// The limit given on the command line, or the end of the Slurm job that this is part of. Throws
/// BadInput.
TimeLimit time_limit_of(const RunOptions& options) {
  if (!options.time_limit.empty()) {
    const auto seconds = seconds_in(options.time_limit);
    if (seconds) return TimeLimit(*seconds);
    throw BadInput("--time-limit " + options.time_limit +
                   ": give seconds, minutes:seconds or hours:minutes:seconds, as in 1:30:00");
  }
  const char* const end = std::getenv("SLURM_JOB_END_TIME");  // s since 1970
  const double left = end == nullptr ? 0.0 : std::atof(end) - calendar_seconds();
  return left > 0.0 ? TimeLimit(left) : TimeLimit();
}

Packed pack(RunningSweep& running, const std::function<PackingNames()>& names,
            const RunOptions& options, Isa isa, const RunRecord& run, const TimeLimit& time_limit) {
  if (running.pending.empty() || stop_signal() != 0) return {};
  if (running.done > 0 && !options.quiet) {
    std::cerr << running.done << " of " << running.done + running.pending.size()
              << " packings are done, going on\n";
  }
  const auto known = std::count_if(running.pending.begin(), running.pending.end(),
                                   [&](auto* job) { return running.beds.contains(job->id); });
  if (known > 0 && !options.quiet) {
    std::cerr << counted(static_cast<std::size_t>(known), "packing")
              << (known == 1 ? " has the bed of a stored one, which is"
                             : " have the beds of stored ones, which are")
              << " measured again\n";
  }
  const Limits limits{run.threads, memory_for_packings()};
  std::cerr << memory_warning(costs_of(running.pending), limits.memory);
  expect_threads(limits.threads);
  const ProgressStyle style = options.quiet ? ProgressStyle::quiet : progress_style();
  const bool tells_packings = style == ProgressStyle::plain || options.fail_fast;
  return pack_pending(running, {limits, isa, style, options.checkpoint_seconds, options.fail_fast,
                                time_limit.from_now(), options.no_grains,
                                tells_packings ? names() : PackingNames()});
}

struct Made {
  Packed packed;
  bool is_whole = false;  ///< whether all that was called for was made
};

Packed sum_of(const Packed& before, const Packed& now) {
  return {before.packings + now.packings, before.left_to_others + now.left_to_others,
          now.first_failure};
}

/// Makes what is pending.
Made made_of(RunningSweep& running, const std::function<Packed(RunningSweep&)>& make) {
  const Packed packed = make(running);
  const int seen_to = packed.packings + packed.left_to_others;
  return {packed, static_cast<std::size_t>(seen_to) == running.pending.size()};
}

/// Makes what is `left`; with `each_bed_once` one packing of each bed first, then the others, whose
/// bed is known by then unless that one failed.
Made make_left(const std::function<RunningSweep()>& left, bool each_bed_once,
               const std::function<Packed(RunningSweep&)>& make) {
  RunningSweep running = left();
  const bool has_others = each_bed_once && put_off_others_of_a_bed(running);
  Made first = made_of(running, make);
  if (!has_others || !first.is_whole) return first;
  RunningSweep others = left();
  const Made rest = made_of(others, make);
  return {sum_of(first.packed, rest.packed), rest.is_whole};
}

/// Makes what is called for, then what its results, `made`, call for, and so on.
Made make_all(GrowingSweep& growing, const std::function<Outcomes()>& made,
              const std::function<Made(const Sweep&)>& make) {
  Made all = make(growing.now());
  while (all.is_whole && growing.grow(made())) {
    const Made more = make(growing.now());
    all = {sum_of(all.packed, more.packed), more.is_whole};
  }
  return all;
}

/// Whether a signal or, with --fail-fast, a failed packing stopped it.
bool was_stopped(const Packed& packed) {
  return stop_signal() != 0 || !packed.first_failure.empty();
}

/// For a runner whose shard is made: takes over from others until nobody needs help.
Made help(const Sweep& sweep, const Shard& shard, const std::string& folder, ShardFiles& files,
          bool is_quiet, const std::function<Packed(RunningSweep&)>& make) {
  const Helping helping(sweep, shard, folder);
  Made all{{}, true};
  for (;;) {
    TakenOver taken = helping.next();
    if (taken.jobs.empty()) return all;
    if (!is_quiet) {
      std::cerr << counted(taken.jobs.size(), "packing") << " of other shards taken over\n";
    }
    RunningSweep running{folder, files, 0, std::move(taken.jobs), {}, std::move(taken.claims)};
    const Outcomes stored = read_journals(folder, Detail::whole).outcomes;
    running.beds = known_beds(folder, stored, running.pending);
    const Packed now = make(running);
    all.packed = sum_of(all.packed, now);
    all.is_whole = !was_stopped(now);
    const auto made = static_cast<std::size_t>(now.packings);
    if (!all.is_whole || made < running.pending.size()) return all;  // or there is no time for more
  }
}

/// Counts of the packings of this runner.
StatusCounts counts_of(const std::vector<Row>& rows, const std::vector<std::size_t>& places) {
  StatusCounts counts;
  for (const std::size_t place : places) count(rows[place], counts);
  return counts;
}

/// Says why the run stopped before its end and how to go on; returns the exit code.
int stopped(const Packed& packed, const RunOptions& options, const std::string& folder,
            const StatusCounts& counts, std::size_t packings) {
  const bool by_signal = stop_signal() != 0, by_failure = !packed.first_failure.empty();
  const std::size_t made = packings - static_cast<std::size_t>(counts.pending);
  std::cerr << (by_signal    ? "Stopped."
                : by_failure ? "Stopped by --fail-fast after " + packed.first_failure + "."
                             : "Stopped by the limit of time.")
            << " " << made << " of " << counted(packings, "packing")
            << (packings == 1 ? " is" : " are") << " kept in " << folder;
  const std::size_t saved = saved_packings(folder);
  if (saved > 0) std::cerr << ", " << saved << " under way in its checkpoints";
  // With all packings kept, --fail-fast stopped at one that was made again.
  const bool retries = options.retry_failed && (by_signal || counts.pending > 0);
  std::cerr << ".\nGo on with: " << called_as() << " run " << shell_path(options.file) << " --out "
            << shell_path(folder) << (retries ? " --retry-failed" : "") << options.repeated << "\n";
  if (by_signal) return exit_stopped + stop_signal();
  return by_failure ? exit_left_out : exit_out_of_time;
}

/// For a run that made all it had to. Packings missing at its end are still being made by others,
/// or were removed meanwhile.
int exit_code_for(const StatusCounts& counts, int left_to_others, const RunOptions& options,
                  const std::string& folder) {
  if (counts.broken_off > 0) {
    const auto broken_off = static_cast<std::size_t>(counts.broken_off);
    std::cerr << "warning: " << counted(broken_off, "packing")
              << " broke off, mostly for lack of memory: see "
              << "the column reason of packings.csv; the same command makes what is missing\n";
    return exit_no_resources;
  }
  if (counts.pending > left_to_others) {
    const auto lost = static_cast<std::size_t>(counts.pending - left_to_others);
    std::cerr << "warning: " << counted(lost, "packing") << (lost == 1 ? " is" : " are")
              << " no longer in " << folder
              << ", though stored there; run the sweep again to make what is missing anew\n";
  }
  const int unsettled = counts.failed + counts.not_settled, ended = unsettled + counts.settled;
  // Shares are compared: both are then the number nearest to what was meant.
  const double share = unsettled / std::max(1.0, 1.0 * ended);
  const bool is_tolerated = share <= options.tolerate_unsettled;
  if (!is_tolerated && options.quiet) {  // otherwise the closing table tells
    std::cerr << "warning: " << unsettled << " of "
              << counted(static_cast<std::size_t>(ended), "packing")
              << " failed or did not settle: see the columns status and reason of packings.csv\n";
  }
  return counts.pending <= left_to_others && is_tolerated ? exit_done : exit_left_out;
}

void record_end(RunRecord& run, int packings, double seconds, ShardFiles& files) {
  run.packings = packings;
  run.wall_seconds = seconds;
  run.ended = utc_now();
  files.add(run);
  files.flush();
}

/// Whether a signal or a limit of time ends the run.
bool is_in_haste(const Made& made, const TimeLimit& limit) {
  const bool lacks_time = !made.is_whole && made.packed.first_failure.empty();
  return stop_signal() != 0 || limit.is_over() || lacks_time;
}

/// Writes tables and page of all packings, or says who does so if there is no time for any
/// `extent`; prints the closing table if the run made all it had to. If several shards find
/// everything made at once, which looks the same to all, the first one writes.
void write_results(Results& results, const RunOptions& options, const std::string& folder,
                   const Shard& shard, bool is_whole, std::optional<PageExtent> extent) {
  std::optional<FileLock> place;
  if (shard.count > 1) place.emplace(tables_lock(folder));
  if (place && place->is_taken()) return;
  if (!extent) {
    std::cerr << "note: tables and page of so many packings take time that is not left; "
              << called_as() << " report " << shell_path(folder) << " writes them\n";
    return;
  }
  std::cerr << damage_warnings(check_beds(folder, results.rows));
  std::cerr << other_versions_warning(results.rows, program_version());
  if (results.orphaned > 0 && !options.quiet) {
    std::cerr << "note: " << counted(results.orphaned, "stored packing")
              << (results.orphaned == 1 ? " is" : " are")
              << " of another sweep or of another form of this one: kept, but in no table"
              << others_remedy(folder) << "\n";
  }
  const auto without_grains =
      std::count_if(results.rows.begin(), results.rows.end(),
                    [](const Row& row) { return row.outcome && lacks_grains(*row.outcome); });
  if (without_grains > 0 && !options.no_grains && !options.quiet) {
    std::cerr << "note: " << counted(static_cast<std::size_t>(without_grains), "packing")
              << (without_grains == 1 ? " is" : " are") << " stored without grains; "
              << grains_remedy(options.file, folder) << "\n";
  }
  const Analysis analysis = analyse(results.rows, folder);
  write_tables(folder, results.provenance, results.rows, analysis);
  if (is_whole && !options.quiet) {
    std::cout << closing_report(results.provenance, results.rows, analysis.families,
                                {called_as(), folder, has_grains(folder, results.rows)})
              << std::flush;
  }
  if (options.no_report) return;
  const std::string where = write_page(folder, results.provenance, results.rows, analysis, *extent);
  if (is_whole && !options.quiet) std::cout << where;
}

/// Says so where a run left an older page as it was.
void tell_of_old_page(const std::string& folder) {
  if (!file_exists(folder + "/report.html")) return;
  std::cerr << "note: " << folder << "/report.html is of an earlier run; " << called_as()
            << " report " << shell_path(folder) << " writes it anew\n";
}

/// Says so where other shards are not ready.
void tell_of_others(const std::vector<Row>& rows, const Shard& shard, const std::string& folder,
                    const RunOptions& options) {
  const auto pending = static_cast<std::size_t>(totals_of(rows).counts.pending);
  std::cout << "Shard " << shard.number << "/" << shard.count << " is done; of the sweep "
            << rows.size() - pending << " of " << counted(rows.size(), "packing")
            << (rows.size() == 1 ? " is in " : " are in ") << folder
            << ". The last shard writes the tables, or: " << called_as() << " run "
            << shell_path(options.file) << " --out " << shell_path(folder) << "\n";
}

/// Remembers the options to go on with as they are given: not what is done once, and neither the
/// folder nor --retry-failed, which the end of the run tells.
void remember_options(CLI::App& run, std::string& repeated) {
  const std::set<std::string> others = {"--help",  "FILE",  "--out",
                                        "--fresh", "--yes", "--retry-failed"};
  for (CLI::Option* option : run.get_options()) {
    if (others.contains(option->get_name())) continue;
    const bool is_flag = option->get_expected_max() == 0;
    option->each([=, name = option->get_name(), &repeated](const std::string& word) {
      const std::string value = is_flag ? "=" + word : " " + shell_word(word);
      repeated += " " + name + (value == "=true" ? "" : value);
    });
  }
}

std::string presets_text() {
  std::string text = "Accuracy, a member of the sweep file:";
  for (const Preset& preset : presets()) {
    text += "\n  " + std::string(preset.name) + ": " + std::string(preset.promise);
  }
  return text;
}

}  // namespace

void add_command(CLI::App& app, RunOptions& options) {
  CLI::App& run = *app.add_subcommand(
      "run", "Make the packings of a sweep, or what is missing of them, and the tables");
  add_file(run, options.file);
  run.add_option("--out", options.out, "output folder (default: out/<sweep name>)")
      ->check(not_empty())
      ->type_name("DIR");
  add_threads(run, options.threads);
  run.add_option("--isa", options.isa,
                 "sse2, avx2 or avx512 (default: GRAINSWEEP_ISA, else the widest)")
      ->check(not_empty())
      ->type_name("NAME");
  run.add_option(
         "--checkpoint-seconds", options.checkpoint_seconds,
         "save packings under way this often, 0: in every step; stopping\nalways saves them")
      ->check(number_within(0.0, 86400.0))
      ->capture_default_str()
      ->type_name("S");
  auto* fresh =
      run.add_flag("--fresh", options.fresh, "delete what is stored in the folder and start anew");
  run.add_flag("--yes", options.yes, "do not ask before --fresh deletes");
  run.add_flag("--retry-failed", options.retry_failed,
               "make failed packings again, after the others, as with a new version");
  run.add_flag("--fail-fast", options.fail_fast,
               "stop at the first packing that fails; without it the others go on");
  run.add_flag("--quiet", options.quiet, "print warnings and errors only");
  run.add_flag("--no-report", options.no_report, "leave out the page report.html and its figures");
  auto* no_grains = run.add_flag("--no-grains", options.no_grains,
                                 "store curves but no grains: beds cannot be shown or exported");
  run.add_flag("--with-grains", options.with_grains,
               "make again, to the same bits, what is stored without grains")
      ->excludes(no_grains);
  auto* jobs = add_jobs(run, options.jobs,
                        "make only these packings: ids in packings.csv or plan --json,\n"
                        "or how they begin");
  auto* shard = run.add_option("--shard", options.shard,
                               "make one part of N in a shared folder: I/N, auto, or auto/N")
                    ->check(not_empty())
                    ->type_name("I/N")
                    ->excludes(jobs);
  fresh->excludes(jobs);  // it would delete the others
  run.add_flag("--alone", options.alone,
               "end with the shard, without taking over what others have not begun")
      ->needs(shard);
  run.add_option("--time-limit", options.time_limit,
                 "end in time; [H:]MM:SS or seconds (default: that of the Slurm job)")
      ->check(not_empty())
      ->type_name("T");
  add_tolerance(run, options.tolerate_unsettled,
                "exit with 0 although packings did not settle; =SHARE: up to that share");
  run.footer("Example: grainsweep run configs/quick.json --out out/quick --threads 2\n\n" +
             presets_text() + "\n\n" + exit_codes_text);
  remember_options(run, options.repeated);
}

int perform(const RunOptions& options) {
  const Sweep whole = sweep_or_refusal(options.file);
  const Isa isa = choose_isa(options.isa);
  const Shard shard = shard_from_option(options.shard, std::getenv);
  const std::string folder = options.out.empty() ? "out/" + whole.name : options.out;
  const TimeLimit time_limit = time_limit_of(options);
  const Provenance provenance = provenance_of(options, whole);
  const std::set<std::string> jobs = jobs_of(shard, whole, options.jobs);
  confirm_fresh(options, folder, shard);
  const double start = wall_seconds();
  RunRecord run = begun_run(options, isa, form_of(whole, provenance.sweeps.front().text));
  expect_fitting_folder(folder, shard, run.form);
  make_folder(folder);
  ShardFiles files(folder, shard, run);
  warn_without_lock(folder, files);
  if (files.is_locked() && shard.count == 1) clean_up(folder);
  if (options.fresh) files.remove_all(run), remove_tables(folder);
  watch_stop_signals();

  const auto made = [&] { return made_for_growth(folder, whole); };
  GrowingSweep growing(whole, made());
  bool retries = false;
  std::optional<PackingNames> known_names;
  const auto names = [&] {
    if (!known_names) known_names = names_in(whole);
    return *known_names;
  };
  const auto make = [&](RunningSweep& running) {
    return pack(running, names, options, isa, run, time_limit);
  };
  const auto make_pending = [&](const Sweep& sweep) {
    record_sweep(folder, provenance, rows_of(sweep));
    const bool retry = std::exchange(retries, false);
    const auto left = [&] {
      return resume(sweep, places_of(jobs, sweep), shard, folder, files,
                    {retry, options.with_grains});
    };
    return make_left(left, shard.count == 1 && !options.no_grains && !retry, make);
  };
  Made own = make_all(growing, made, make_pending);
  if (own.is_whole && options.retry_failed) {
    retries = true;  // once, and after what was never made: a short time is for that
    const Made again = make_all(growing, made, make_pending);
    const bool lacks_time = !again.is_whole && !was_stopped(again.packed);
    if (lacks_time) std::cerr << "note: no time was left to make all failed packings again\n";
    own = {sum_of(own.packed, again.packed), again.is_whole || lacks_time};
  }
  if (own.is_whole && shard.count > 1 && !options.alone && !grows(whole)) {
    const Made more = help(whole, shard, folder, files, options.quiet, make);
    own = {sum_of(own.packed, more.packed), more.is_whole};
  }
  const auto& [packed, is_whole] = own;
  const auto extent = extent_at_end(growing.now().jobs.size(), is_in_haste(own, time_limit));
  record_end(run, packed.packings, wall_seconds() - start, files);

  const auto stored = [&](Detail detail) {
    return read_called_for(growing, provenance, folder, detail);
  };
  const bool is_alone = shard.count == 1;
  const bool needs_whole = (is_alone && extent) || grows(whole);
  Results results = stored(needs_whole ? Detail::whole : Detail::summary);
  const StatusCounts all = totals_of(results.rows).counts;
  const bool has_all = is_alone || all.pending == all.broken_off;
  if (has_all && !is_alone && extent) results = stored(Detail::whole);
  if (has_all) {
    write_results(results, options, folder, shard, is_whole, extent);
    forget_claims(folder);
    if (is_whole && !options.quiet) std::cout << results.wishes;
    if (options.no_report && packed.packings > 0) tell_of_old_page(folder);
  } else if (is_whole && !options.quiet) {
    tell_of_others(results.rows, shard, folder, options);
  }
  const std::vector<std::size_t> places = places_of(jobs, growing.now());
  const StatusCounts counts = counts_of(results.rows, places);
  return is_whole && (extent || !has_all)
             ? exit_code_for(counts, packed.left_to_others, options, folder)
             : stopped(packed, options, folder, counts, places.size());
}

}  // namespace grainsweep
