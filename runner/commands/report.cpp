// The command `report`: the closing table again.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/tables/closing_report.hpp"

namespace grainsweep {

CLI::App& add_command(CLI::App& app, ReportOptions& options) {
  CLI::App& report = *app.add_subcommand("report", "Print the closing table of a run again");
  add_folder(report, options.folder);
  report.footer("Example: grainsweep report out/quick");
  return report;
}

int perform(const ReportOptions& options) {
  Results results = results_with_warnings(options.folder);
  std::cerr << damage_warnings(check_beds(options.folder, results.rows));
  std::cout << closing_report(results.provenance, results.rows, analyse(results.rows).families,
                              options.folder);
  return exit_done;
}

}  // namespace grainsweep
