// The closing table: what a person reads when a sweep is done.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

/// Whose tables they are.
struct ReportPlace {
  std::string program;        ///< how the program was called, as a shell takes it
  std::string folder;         ///< output folder
  bool has_grains = true;     ///< whether its beds can be exported, see has_grains
  bool is_worked_on = false;  ///< a runner makes what is missing
  bool has_tables = true;     ///< false if they could not be written
};

/// Whether the first bed that is stored in the folder has its grains; beds of a run with
/// --no-grains have none. False if no bed is stored.
bool has_grains(const std::string& folder, const std::vector<Row>& rows);

/// Means and scatter of the groups, the fitted wall effect of each family with 3 or more widths,
/// the definitions behind the numbers, what it cost, where the files are and what to do next. Other
/// families of equal labels share a table. UTF-8, at most 100 columns where labels are of ordinary
/// length.
std::string closing_report(const Provenance& provenance, const std::vector<Row>& rows,
                           const std::vector<Family>& families, const ReportPlace& place);

}  // namespace grainsweep
