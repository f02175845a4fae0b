// The command `report`: closing table and page again.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/store/files.hpp"
#include "runner/store/runners.hpp"
#include "runner/tables/closing_report.hpp"

namespace grainsweep {

CLI::App& add_command(CLI::App& app, ReportOptions& options) {
  CLI::App& report = *app.add_subcommand(
      "report", "Print the closing table of a run again, and write its page, report.html");
  add_folder(report, options.folder);
  report.footer("Example: grainsweep report out/quick");
  return report;
}

int perform(const ReportOptions& options) {
  Results results = results_with_warnings(options.folder);
  std::cerr << damage_warnings(check_beds(options.folder, results.rows));
  const Analysis analysis = analyse(results.rows, options.folder);
  std::cout << closing_report(
                   results.provenance, results.rows, analysis.families,
                   {called_as(), options.folder, has_grains(options.folder, results.rows),
                    is_worked_on(options.folder, results.last_runs)})
            << std::flush;
  try {
    std::cout << write_page(options.folder, results.provenance, results.rows, analysis);
  } catch (const FileError& error) {
    std::cerr << "warning: there is no new page: " << error.what() << "\n";
  }
  return exit_done;
}

}  // namespace grainsweep
