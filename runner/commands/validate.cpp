// The command `validate`: whether a sweep file is right.
#include <algorithm>
#include <iostream>
#include <string>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/jobs/growing_groups.hpp"
#include "runner/jobs/schedule.hpp"
#include "runner/machine.hpp"
#include "runner/sweep/costs.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/tables/chosen_presets.hpp"
#include "runner/tables/units.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// ", widths of 16 to 64 mm": lengths that were written in mm where those in d are meant show here.
std::string widths_text(const Sweep& sweep) {
  if (sweep.jobs.empty()) return "";
  const auto [least, most] = std::minmax_element(
      sweep.jobs.begin(), sweep.jobs.end(),
      [](const Job& a, const Job& b) { return a.spec.box.width < b.spec.box.width; });
  const auto length = [&](const Job& job) { return length_in(*sweep.units, job.spec.box.width); };
  const bool is_one = length(*least) == length(*most);
  return std::string(is_one ? ", width " : ", widths of ") +
         (is_one ? "" : length(*least) + " to ") + length(*most) + " " + printed_unit(*sweep.units);
}

}  // namespace

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
  std::cout << without_controls(options.file) << ": right: " << (grows(whole) ? "at least " : "")
            << counted(sweep.jobs.size(), "packing") << ", "
            << counted(parameter_sets(sweep.jobs).size(), "parameter set")
            << (sweep.units ? ", " + units_text(*sweep.units) + widths_text(sweep) : "") << "\n"
            << chosen_presets_text(sweep);
  std::cerr << memory_warning(costs_of(sweep.jobs), memory_for_packings());
  return exit_done;
}

}  // namespace grainsweep
