// The commands that look at an output folder: `report`, `compare`, `status`, `export`.
#include <algorithm>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>

#include "runner/commands.hpp"
#include "runner/compare/comparison.hpp"
#include "runner/exit_codes.hpp"
#include "runner/report.hpp"
#include "runner/results.hpp"
#include "runner/store/files.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/states.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

Results results_with_warnings(const std::string& folder) {
  Results results = read_results(folder);
  std::cerr << damage_warnings(folder, results.damage);
  std::cerr << other_versions_warning(results.rows, program_version());
  return results;
}

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

bool has_grains(const Row& row) { return row.outcome && row.outcome->stored_grains > 0; }

/// The rows to export: those asked for, or all that have grains. Throws BadInput.
std::vector<const Row*> rows_to_export(const std::vector<Row>& rows, const ExportOptions& options) {
  std::vector<const Row*> chosen;
  for (const std::string& job : options.jobs) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.job.id == job; });
    if (found == rows.end()) {
      throw BadInput("--job " + job + ": no such packing; see the column job in " + options.folder +
                     "/packings.csv");
    }
    if (!has_grains(*found))
      throw BadInput("--job " + job + ": has no grains, it is " + status_of(*found));
    chosen.push_back(&*found);
  }
  for (const Row& row : rows) {
    if (options.jobs.empty() && has_grains(row)) chosen.push_back(&row);
  }
  return chosen;
}

}  // namespace

int report(const ReportOptions& options) {
  const Results results = results_with_warnings(options.folder);
  std::cout << closing_report(results.provenance, results.rows, options.folder);
  return exit_done;
}

int compare(const CompareOptions& options) {
  Results results = results_with_warnings(options.folder);
  std::cerr << damage_warnings(options.folder, load_curves(options.folder, results.rows));
  const auto rows = compare_with_paper(families_of(groups_of(results.rows)));
  std::cout << "Camenen, Descantes, Richard, Confined packings of frictionless spheres and "
               "polyhedra,\nPowders & Grains 2013, and " +
                   results.provenance.sweep.name +
                   ". Lengths in d. Errors of means come\nfrom the variance of replicates pooled "
                   "over the groups of a family. Definitions below each row.\n\n"
            << comparison_text(rows);
  return exit_done;
}

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

int export_grains(const ExportOptions& options) {
  const auto format = export_format(options.format);
  if (!format) throw BadInput("--format " + options.format + ": use csv, xyz or vtp");
  const Results results = results_with_warnings(options.folder);
  const std::vector<const Row*> rows = rows_to_export(results.rows, options);
  const std::string to = options.to.empty() ? options.folder + "/export" : options.to;
  if (rows.empty()) throw BadInput(options.folder + ": holds no finished packing to export");
  make_folder(to);
  for (const Row* row : rows) {
    const StoredBed bed = read_bed(options.folder, row->job.id);
    replace_file(to + "/" + row->job.id + "." + name_of(*format), grains_text(bed, *format));
  }
  std::cout << rows.size() << (rows.size() == 1 ? " packing" : " packings") << " written to " << to
            << "/<job>." << name_of(*format) << "\n";
  return exit_done;
}

}  // namespace grainsweep
