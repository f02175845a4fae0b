// distributions.csv: curves of each group, a row per point, mean and scatter over the replicates.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// The whole file.
std::string distributions_csv(const std::vector<Group>& groups);

std::vector<ColumnText> distributions_columns(const Varied& varied);

}  // namespace grainsweep
