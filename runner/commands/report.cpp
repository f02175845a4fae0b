// The command `report`: the closing table again.
#include <iostream>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/exit_codes.hpp"
#include "runner/tables/closing_report.hpp"

namespace grainsweep {

int report(const ReportOptions& options) {
  const Results results = results_with_warnings(options.folder);
  std::cout << closing_report(results.provenance, results.rows, analyse(results.rows).families,
                              options.folder);
  return exit_done;
}

}  // namespace grainsweep
