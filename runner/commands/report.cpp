// The command `report`: closing table, tables and page again.
#include <algorithm>
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/store/runners.hpp"
#include "runner/store/shard.hpp"
#include "runner/tables/closing_report.hpp"

namespace grainsweep {
namespace {

/// Whether write() wrote `what`; if not, says why.
template <class Write>
bool is_written(const char* what, const Write& write) {
  try {
    write();
    return true;
  } catch (const FileError& error) {
    std::cerr << called_as() << ": there " << what << ": " << error.what() << "\n";
    return false;
  }
}

/// Why tables of these rows would hold nothing, though there may be good ones; "" if packings are
/// made or none was. `bed_damage`: as check_beds() returns it.
std::string why_nothing_is_read(const std::string& folder, const Results& results,
                                const std::vector<std::string>& bed_damage) {
  if (std::any_of(results.rows.begin(), results.rows.end(), is_made)) return "";
  if (shards_in(folder).empty()) {
    return "the folder of what is stored, " + shards_folder(folder) + ", is missing or empty";
  }
  return results.damage.empty() && bed_damage.empty()
             ? ""
             : "nothing stored there can be read, since it is damaged or of another version";
}

}  // namespace

void add_command(CLI::App& app, ReportOptions& options) {
  CLI::App& report = *app.add_subcommand(
      "report",
      "Print the closing table of a run again, and write its tables and page, report.html");
  add_folder(report, options.folder);
  report.footer("Example: grainsweep report out/quick");
}

int perform(const ReportOptions& options) {
  Results results = results_with_warnings(options.folder);
  const std::vector<std::string> bed_damage = check_beds(options.folder, results.rows);
  std::cerr << damage_warnings(bed_damage);
  const std::string why = why_nothing_is_read(options.folder, results, bed_damage);
  if (!why.empty()) {
    std::cerr << called_as() << ": " << options.folder << ": " << why
              << "; tables and page are left as they were\n";
    return exit_file_system;
  }
  const Analysis analysis = analyse(results.rows, options.folder);
  const bool is_at_work = is_worked_on(options.folder, results.last_runs);
  // A run at work writes them itself.
  const bool has_tables =
      is_at_work || is_written("are no new tables", [&] {
        for (const char* part : {"", "/figures"}) remove_leftovers_of_ended(options.folder + part);
        write_tables(options.folder, results.provenance, results.rows, analysis);
      });
  std::cout << closing_report(results.provenance, results.rows, analysis.families,
                              {called_as(), options.folder,
                               has_grains(options.folder, results.rows), is_at_work, has_tables})
            << std::flush;
  const bool has_page = is_written("is no new page", [&] {
    std::cout << write_page(options.folder, results.provenance, results.rows, analysis);
  });
  return has_tables && has_page && bed_damage.empty() ? exit_done : exit_file_system;
}

}  // namespace grainsweep
