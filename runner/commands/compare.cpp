// The command `compare`: stored results beside printed ones.
#include <iostream>

#include "runner/commands/commands.hpp"
#include "runner/commands/inputs.hpp"
#include "runner/compare/comparison.hpp"
#include "runner/exit_codes.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

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

}  // namespace grainsweep
