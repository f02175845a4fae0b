// The command `status`: how much of a sweep is done, who is at work, and how long it will take.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "runner/cluster/job_scripts.hpp"
#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/estimates.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/store/runners.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Runners that are named one by one; of more only the number is given.
constexpr std::size_t runners_named = 4;

/// All that is known of an output folder.
struct Standing {
  std::string folder;
  Results results;
  Totals totals;
  std::vector<Runner> working, lost;  ///< none is lost where nothing is left to be made
  std::optional<Queue> queue;         ///< of jobs that the command `slurm` submitted
  double seconds_left = 0.0;          ///< of CPU, learned from finished packings
  int threads = 0;                    ///< of all runners at work
  bool is_damaged = false;            ///< beds are missing or damaged, as far as they were read
};

double cpu_seconds_left(const std::vector<Row>& rows) {
  std::vector<Known> packings;
  packings.reserve(rows.size());
  for (const Row& row : rows) {
    packings.push_back({row.job.estimated, std::nullopt});
    if (is_made(row)) packings.back().measured = row.outcome->cpu_seconds;
  }
  const std::vector<double> seconds = learned(packings);
  double left = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) left += is_made(rows[i]) ? 0.0 : seconds[i];
  return left;
}

/// Whether the command `slurm` has submitted shards of it.
bool is_submitted(const std::string& folder) {
  std::error_code not_there;
  return std::filesystem::is_directory(scripts_folder(folder), not_there);
}

std::optional<Queue> queue_of(const std::string& folder) {
  if (!is_submitted(folder)) return std::nullopt;
  return ask_for_queue(
      scripts_folder(std::filesystem::absolute(folder).lexically_normal().string()));
}

/// Prints warnings about damage.
Standing standing_of(const std::string& folder, bool check) {
  Standing standing{folder, results_with_warnings(folder, Detail::summary), {}, {}, {}, {}};
  std::vector<Row>& rows = standing.results.rows;
  const std::vector<std::string> damage =
      check ? check_beds(folder, rows) : expect_beds(folder, rows);
  std::cerr << damage_warnings(damage);
  standing.is_damaged = !damage.empty();
  standing.totals = totals_of(rows);
  const bool is_done = standing.totals.counts.pending == 0;
  for (Runner& runner : runners_in(folder, standing.results.last_runs)) {
    if (!runner.is_lost) standing.threads += runner.run.threads;
    if (runner.is_lost && is_done) continue;
    (runner.is_lost ? standing.lost : standing.working).push_back(std::move(runner));
  }
  const auto makes_all = [](const Runner& runner) { return runner.shard == "1-of-1"; };
  if (std::any_of(standing.working.begin(), standing.working.end(), makes_all)) {
    standing.lost.clear();  // what they had is made by that one
  }
  standing.queue = queue_of(folder);
  standing.seconds_left = cpu_seconds_left(rows);
  return standing;
}

std::string progress_text(const StatusCounts& counts, std::size_t packings) {
  const std::size_t done = packings - static_cast<std::size_t>(counts.pending);
  return std::to_string(done) + " of " + counted(packings, "packing") +
         " done: " + std::to_string(counts.settled) + " settled, " +
         std::to_string(counts.not_settled) + " not settled, " + std::to_string(counts.failed) +
         " failed" +
         (counts.broken_off > 0 ? "; " + std::to_string(counts.broken_off) + " broke off" : "");
}

std::string name_of(const Runner& runner) {
  const std::string owner = owner_text(runner.run) + " (" + runner.shard;
  return owner + (runner.is_lost ? ", silent for " + duration_text(runner.silent) : "") + ")";
}

std::string names_of(const std::vector<Runner>& runners) {
  std::string text;
  for (std::size_t i = 0; i < std::min(runners.size(), runners_named); ++i) {
    text += (i > 0 ? "; " : "") + name_of(runners[i]);
  }
  if (runners.size() <= runners_named) return text;
  return text + "; and " + std::to_string(runners.size() - runners_named) + " more";
}

std::string runners_text(const Standing& standing) {
  std::string text = standing.working.empty() ? "No runner at work\n"
                                              : "Running: " + names_of(standing.working) + "\n";
  if (!standing.lost.empty()) {
    text += "Lost: " + names_of(standing.lost) + "; what they had is made by the next run\n";
  }
  return text;
}

std::string queue_text(const Queue& queue) {
  std::string text = "Slurm: " + counted(static_cast<std::size_t>(queue.running), "job") +
                     " running, " + std::to_string(queue.pending) + " pending";
  if (!queue.blocking.empty()) text += ", held back: " + queue.blocking;
  return text + "\n";
}

std::string left_text(const Standing& standing) {
  std::string text = "Left: about " + duration_text(standing.seconds_left) + " CPU";
  if (standing.threads > 0) {
    text += ", " + duration_text(standing.seconds_left / standing.threads) + " on the " +
            counted(static_cast<std::size_t>(standing.threads), "core") + " at work";
  }
  return text + "\n";
}

bool is_idle(const Standing& standing) {
  const bool waits = standing.queue && standing.queue->running + standing.queue->pending > 0;
  return standing.working.empty() && !waits;
}

void print_status(const Standing& standing) {
  const Results& results = standing.results;
  const std::string sweep_file = sweep_file_of(results.provenance);
  const bool is_done = standing.totals.counts.pending == 0;
  std::cout << results.provenance.sweep_name << ": "
            << progress_text(standing.totals.counts, results.rows.size()) << "; "
            << duration_text(standing.totals.cpu_seconds) << " CPU\n"
            << runners_text(standing) << (standing.queue ? queue_text(*standing.queue) : "")
            << (is_done ? "" : left_text(standing));
  if (results.orphaned > 0) {
    std::cout << counted(results.orphaned, "stored packing")
              << (results.orphaned == 1 ? " belongs" : " belong") << " to another form of the sweep"
              << others_remedy(standing.folder) << "\n";
  }
  if (is_idle(standing) && !is_done && !sweep_file.empty()) {
    std::cout << "Go on with: " << called_as() << " run " << shell_path(sweep_file) << " --out "
              << shell_path(standing.folder) << "\n";
  }
}

std::vector<std::string> all_names(const std::vector<Runner>& runners) {
  std::vector<std::string> names;
  names.reserve(runners.size());
  for (const Runner& runner : runners) names.push_back(name_of(runner));
  return names;
}

nlohmann::ordered_json status_json(const Standing& standing) {
  const Results& results = standing.results;
  const StatusCounts& counts = standing.totals.counts;
  nlohmann::ordered_json status = {{"name", results.provenance.sweep_name},
                                   {"folder", standing.folder},
                                   {"sweep_file", sweep_file_of(results.provenance)},
                                   {"packings", results.rows.size()},
                                   {"settled", counts.settled},
                                   {"not_settled", counts.not_settled},
                                   {"failed", counts.failed},
                                   {"pending", counts.pending},
                                   {"broken_off", counts.broken_off},
                                   {"of_an_earlier_sweep", results.orphaned},
                                   {"cpu_seconds", standing.totals.cpu_seconds},
                                   {"cpu_seconds_left", standing.seconds_left},
                                   {"threads", standing.threads},
                                   {"runners", all_names(standing.working)},
                                   {"lost_runners", all_names(standing.lost)}};
  if (standing.queue) {
    status["slurm"] = {{"running", standing.queue->running}, {"pending", standing.queue->pending}};
  }
  return status;
}

/// For a folder whose shards are submitted, but none has begun.
nlohmann::ordered_json waiting_json(const std::string& folder) {
  nlohmann::ordered_json status = {{"folder", folder}, {"packings", nullptr}};
  if (const auto queue = queue_of(folder)) {
    status["slurm"] = {{"running", queue->running}, {"pending", queue->pending}};
  }
  return status;
}

void print_waiting(const std::string& folder) {
  const std::optional<Queue> queue = queue_of(folder);
  std::cout << folder << ": submitted, nothing is made yet\n" << (queue ? queue_text(*queue) : "");
  if (queue && queue->running + queue->pending == 0) {
    std::cout << "None of its jobs waits or runs: see the logs in " << scripts_folder(folder)
              << ", and submit it again\n";
  }
}

/// Prints what is known of a folder, or adds it to `all`; returns the exit code that it calls for.
ExitCode tell(const std::string& folder, const StatusOptions& options,
              nlohmann::ordered_json& all) {
  if (is_submitted(folder) && !file_exists(provenance_path(folder))) {
    options.json ? all.push_back(waiting_json(folder)) : print_waiting(folder);
    return exit_done;
  }
  const Standing standing = standing_of(folder, options.check);
  options.json ? all.push_back(status_json(standing)) : print_status(standing);
  return standing.is_damaged ? exit_file_system : exit_done;
}

}  // namespace

void add_command(CLI::App& app, StatusOptions& options) {
  CLI::App& status =
      *app.add_subcommand("status", "Say how much of a sweep is done and who is at work");
  status.add_option("DIR", options.folders, "output folders")->required()->type_name("");
  status.add_flag("--json", options.json, "as JSON: an object, of several folders a list");
  status.add_flag("--check", options.check,
                  "read every file of grains whole; otherwise only their names and sizes.\n"
                  "Damage that is found ends it with code 4");
  status.footer("Example: grainsweep status out/quick");
}

int perform(const StatusOptions& options) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  ExitCode end = exit_done;
  for (const std::string& folder : options.folders) {
    try {
      end = std::max(end, tell(folder, options, all));
    } catch (const BadInput& error) {
      if (options.folders.size() == 1) throw;
      std::cerr << lines_without_controls(error.what()) << "\n";  // the others are still reported
      end = std::max(end, exit_bad_input);
    } catch (const FileError& error) {
      if (options.folders.size() == 1) throw;
      std::cerr << lines_without_controls(error.what()) << "\n";
      end = exit_file_system;
    }
  }
  if (options.json) {
    const nlohmann::ordered_json& text = options.folders.size() == 1 ? all.front() : all;
    std::cout << text.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  }
  return end;
}

}  // namespace grainsweep
