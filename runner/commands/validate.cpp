// The command `validate`: whether a sweep file is right.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/tables/chosen_presets.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {

void add_command(CLI::App& app, ValidateOptions& options) {
  CLI::App& validate =
      *app.add_subcommand("validate", "Check a sweep file and say everything wrong with it");
  add_file(validate, options.file);
  validate.footer("Example: grainsweep validate configs/quick.json");
}

int perform(const ValidateOptions& options) {
  const Sweep whole = sweep_with_notes(options.file);
  const GrowingSweep growing(whole, {});
  const Sweep& sweep = growing.now();
  std::cout << options.file << ": right: " << (grows(whole) ? "at least " : "")
            << counted(sweep.jobs.size(), "packing") << ", "
            << counted(parameter_sets(sweep.jobs).size(), "parameter set")
            << (sweep.units ? ", " + units_text(*sweep.units) : "") << "\n"
            << chosen_presets_text(sweep);
  return exit_done;
}

}  // namespace grainsweep
