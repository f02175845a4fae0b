// comparison.csv: each published value beside the measured one, a row for each width of a formula.
#pragma once

#include <string>
#include <vector>

#include "runner/compare/comparison.hpp"
#include "runner/tables/columns.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// The whole file. A value of which one side is not known has a row, too.
std::string comparison_csv(const std::vector<Comparison>& comparisons, const GivenUnits& units);

std::vector<ColumnText> comparison_columns(const GivenUnits& units = {});

}  // namespace grainsweep
