// The closing table: what a person reads when a sweep is done.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/families.hpp"
#include "runner/tables/provenance.hpp"

namespace grainsweep {

/// Means and scatter per width, the fitted wall effect of each family, the definitions behind the
/// numbers, what it cost, where the files are and what to do next. UTF-8, at most 100 columns where
/// labels are of ordinary length. `folder` is the output folder.
std::string closing_report(const Provenance& provenance, const std::vector<Row>& rows,
                           const std::vector<Family>& families, const std::string& folder);

}  // namespace grainsweep
