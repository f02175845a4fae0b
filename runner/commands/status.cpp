// The command `status`: how much of a sweep is done, and who is at work.
#include <iostream>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/store/shard_files.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

std::string progress_text(const StatusCounts& counts, std::size_t packings) {
  const std::size_t done = packings - static_cast<std::size_t>(counts.pending);
  return std::to_string(done) + " of " + std::to_string(packings) +
         " packings done: " + std::to_string(counts.settled) + " settled, " +
         std::to_string(counts.not_settled) + " not settled, " + std::to_string(counts.failed) +
         " failed";
}

std::string runners_text(const std::vector<std::string>& runners) {
  std::string text;
  for (const std::string& runner : runners) text += (text.empty() ? "Running: " : "; ") + runner;
  return text.empty() ? "No runner at work" : text;
}

void print_status(const Results& results, const std::vector<std::string>& runners,
                  const std::string& folder) {
  const Totals totals = totals_of(results.rows);
  const std::string sweep_file = sweep_file_of(results.provenance);
  std::cout << results.provenance.sweep_name << ": "
            << progress_text(totals.counts, results.rows.size()) << "; "
            << duration_text(totals.cpu_seconds) << " CPU\n"
            << runners_text(runners) << "\n";
  if (results.orphaned > 0) {
    std::cout << results.orphaned << " stored packings belong to an earlier form of the sweep\n";
  }
  if (runners.empty() && totals.counts.pending > 0 && !sweep_file.empty()) {
    std::cout << "Go on with: " << called_as() << " run " << shell_word(sweep_file) << " --out "
              << shell_word(folder) << "\n";
  }
}

void print_status_json(const Results& results, const std::vector<std::string>& runners) {
  const Totals totals = totals_of(results.rows);
  nlohmann::ordered_json status = {
      {"name", results.provenance.sweep_name},    {"sweep_file", sweep_file_of(results.provenance)},
      {"packings", results.rows.size()},          {"settled", totals.counts.settled},
      {"not_settled", totals.counts.not_settled}, {"failed", totals.counts.failed},
      {"pending", totals.counts.pending},         {"of_an_earlier_sweep", results.orphaned},
      {"cpu_seconds", totals.cpu_seconds},        {"runners", runners}};
  std::cout << status.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace

CLI::App& add_command(CLI::App& app, StatusOptions& options) {
  CLI::App& status =
      *app.add_subcommand("status", "Say how much of a sweep is done and who is at work");
  add_folder(status, options.folder);
  status.add_flag("--json", options.json, "as JSON");
  status.add_flag("--check", options.check,
                  "read every file of grains whole; otherwise only their names and sizes");
  status.footer("Example: grainsweep status out/quick");
  return status;
}

int perform(const StatusOptions& options) {
  Results results = results_with_warnings(options.folder, Detail::summary);
  const auto look_at_beds = options.check ? check_beds : expect_beds;
  std::cerr << damage_warnings(look_at_beds(options.folder, results.rows));
  const std::vector<std::string> runners = present_runners(options.folder);
  if (options.json) {
    print_status_json(results, runners);
  } else {
    print_status(results, runners, options.folder);
  }
  return exit_done;
}

}  // namespace grainsweep
