// The command `status`: how much of a sweep is done, and who is at work.
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/results.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/lock.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

std::string progress_text(const StatusCounts& counts, std::size_t packings) {
  const std::size_t done = packings - static_cast<std::size_t>(counts.pending);
  return std::to_string(done) + " of " + std::to_string(packings) +
         " packings done: " + std::to_string(counts.settled) + " settled, " +
         std::to_string(counts.not_settled) + " not settled, " + std::to_string(counts.failed) +
         " failed";
}

void print_status(const Overview& overview, const std::optional<std::string>& runner,
                  const std::string& folder) {
  std::cout << overview.name << ": " << progress_text(overview.counts, overview.packings) << "; "
            << duration_text(overview.cpu_seconds) << " CPU\n"
            << (runner ? "Running: " + *runner : std::string("No runner at work")) << "\n";
  if (overview.foreign > 0) {
    std::cout << overview.foreign << " stored packings belong to an earlier form of the sweep\n";
  }
  if (!runner && overview.counts.pending > 0 && !overview.sweep_file.empty()) {
    std::cout << "Go on with: grainsweep run " << shell_word(overview.sweep_file) << " --out "
              << shell_word(folder) << "\n";
  }
}

void print_status_json(const Overview& overview, const std::optional<std::string>& runner) {
  nlohmann::ordered_json status = {{"name", overview.name},
                                   {"sweep_file", overview.sweep_file},
                                   {"packings", overview.packings},
                                   {"settled", overview.counts.settled},
                                   {"not_settled", overview.counts.not_settled},
                                   {"failed", overview.counts.failed},
                                   {"pending", overview.counts.pending},
                                   {"of_an_earlier_sweep", overview.foreign},
                                   {"cpu_seconds", overview.cpu_seconds},
                                   {"runner", nullptr}};
  if (runner) status["runner"] = *runner;
  std::cout << status.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

}  // namespace

int status(const StatusOptions& options) {
  const Overview overview = read_overview(options.folder, program_version());
  std::cerr << damage_warnings(options.folder, overview.damage);
  std::cerr << other_versions_warning(overview.other_versions, overview.packings,
                                      program_version());
  const auto runner = present_runner(options.folder);
  if (options.json) {
    print_status_json(overview, runner);
  } else {
    print_status(overview, runner, options.folder);
  }
  return exit_done;
}

}  // namespace grainsweep
