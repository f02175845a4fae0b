// The command `compare`: stored results beside published values.
#include <algorithm>
#include <iostream>

#include <CLI/App.hpp>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/commands/shared_options.hpp"
#include "runner/compare/comparison.hpp"
#include "runner/compare/comparison_table.hpp"
#include "runner/compare/unit_notes.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/families.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// The shipped file that fits packings of a sweep; "" if there is none.
std::string fitting_reference(const std::vector<Row>& rows) {
  const auto all = [&](const auto& is_such) {
    return std::all_of(rows.begin(), rows.end(), is_such);
  };
  const auto is_of = [](const char* shape) {
    return [=](const Row& row) { return row.job.shape == shape; };
  };
  const bool are_tubes = all([](const Row& row) { return row.job.box.is_tube; });
  if (all(is_of("sphere"))) {
    return are_tubes ? "tubes.reference.json" : "paper-spheres.reference.json";
  }
  return all(is_of("pinacoid")) && !are_tubes ? "paper-pinacoids.reference.json" : "";
}

/// The file asked for, the one beside the sweep, or that kept in the output folder. Throws BadInput
/// if there is none.
std::string reference_file(const CompareOptions& options, const Provenance& provenance,
                           const std::vector<Row>& rows) {
  if (!options.with.empty()) return options.with;
  const std::string sweep_file = sweep_file_of(provenance);
  std::string beside = reference_beside(sweep_file);
  if (!sweep_file.empty() && file_exists(beside)) return beside;
  std::string kept = kept_reference(options.folder);
  if (file_exists(kept)) {
    std::cerr << "note: published values are those of the last run, kept in " << kept
              << (sweep_file.empty() ? "" : ": " + beside + " is not there") << "\n";
    return kept;
  }
  const std::string fitting = fitting_reference(rows);
  throw BadInput(options.folder + ": there are no published values beside the sweep" +
                 (sweep_file.empty() ? "" : " (" + beside + ")") +
                 "; name their file: --with FILE" +
                 (fitting.empty() ? "" : ", such as " + fitting) +
                 (fitting.empty() ? "; configs/README.md says how to write one"
                                  : " in the folder configs that grainsweep comes with"));
}

/// The published values in a file. Throws BadInput, also if it cannot be read: it was named.
Reference named_reference(const std::string& file) try {
  return read_reference(file);
} catch (const FileError& error) {
  throw BadInput(error.what());
}

}  // namespace

void add_command(CLI::App& app, CompareOptions& options) {
  CLI::App& compare = *app.add_subcommand(
      "compare", "Print results beside published values, and whether they agree");
  add_folder(compare, options.folder);
  compare
      .add_option("--with", options.with,
                  "published values, JSON (default: SWEEP.reference.json beside SWEEP.json, or "
                  "the copy of it in DIR)")
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
  const Reference reference =
      named_reference(reference_file(options, results.provenance, results.rows));
  const std::vector<std::string> damage = check_beds(options.folder, results.rows);
  std::cerr << damage_warnings(damage);
  const ExitCode end = damage.empty() ? exit_done : exit_file_system;
  const Analysis analysis = analyse(results.rows, options.folder);
  if (const GivenUnits& units = results.provenance.units) {
    std::cerr << notes_on_lengths(reference, analysis.families, *units);
  }
  if (options.as_csv) {
    std::cout << comparison_csv(compare_with(reference, analysis), results.provenance.units);
    return end;
  }
  std::cout
      << reference.source + "\nbeside " + results.provenance.sweep_name +
             ". Lengths in d. Errors of means come from the variance of replicates, moderated\n"
             "by that of the others of the family; those of profiles from their group alone.\n"
             "They are wider where few packings tell them. Values agree within " +
             fixed(agreement_limit, 0) +
             " standard errors\nof both sides together (ours alone where the source has none) and "
             "the bound of\nsettling, where that was measured.\n" +
             comparison_text(reference, analysis);
  return end;
}

}  // namespace grainsweep
