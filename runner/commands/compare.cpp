// The command `compare`: stored results beside published values.
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/compare/comparison.hpp"
#include "runner/compare/comparison_table.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/families.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// The file asked for, or the one beside the sweep. Throws BadInput if there is none.
std::string reference_file(const CompareOptions& options, const Provenance& provenance) {
  if (!options.with.empty()) return options.with;
  const std::string sweep_file = sweep_file_of(provenance);
  std::string beside = reference_beside(sweep_file);
  if (!sweep_file.empty() && file_exists(beside)) return beside;
  throw BadInput(options.folder + ": there are no published values beside the sweep" +
                 (sweep_file.empty() ? "" : " (" + beside + ")") +
                 "; name their file: --with configs/paper-spheres.reference.json");
}

}  // namespace

void add_command(CLI::App& app, CompareOptions& options) {
  CLI::App& compare = *app.add_subcommand(
      "compare", "Print results beside published values, and whether they agree");
  add_folder(compare, options.folder);
  compare
      .add_option("--with", options.with,
                  "published values, JSON (default: SWEEP.reference.json beside SWEEP.json)")
      ->type_name("FILE");
  compare.add_flag("--csv", options.as_csv,
                   "as CSV, a row for each value and each width of a formula; run and report write "
                   "the same to comparison.csv");
  compare.footer(
      "Each row says what was measured and how, by how much it differs from the\n"
      "published value, and how many standard errors that is; \"not determined\" and why\n"
      "where the sweep does not tell.\n\nExample: grainsweep compare out/paper-spheres\n"
      "Example: grainsweep compare out/paper-spheres --csv > comparison.csv\n"
      "Example: grainsweep compare out/quick --with configs/paper-spheres.reference.json");
}

int perform(const CompareOptions& options) {
  Results results = results_with_warnings(options.folder);
  const Reference reference = read_reference(reference_file(options, results.provenance));
  std::cerr << damage_warnings(check_beds(options.folder, results.rows));
  const Analysis analysis = analyse(results.rows, options.folder);
  if (options.as_csv) {
    std::cout << comparison_csv(compare_with(reference, analysis), results.provenance.units);
    return exit_done;
  }
  std::cout
      << reference.source + "\nbeside " + results.provenance.sweep_name +
             ". Lengths in d. Errors of means come from the variance of replicates, moderated\n"
             "by that of the others of the family; those of profiles from their group alone.\n"
             "They are wider where few packings tell them. Values agree within " +
             fixed(agreement_limit, 0) +
             " standard errors of both sides together (ours alone where\nthe source has none) and "
             "the "
             "bound of settling, where that was measured.\n" +
             comparison_text(reference, analysis);
  return exit_done;
}

}  // namespace grainsweep
