// distributions.csv: curves of each group, a row per point, mean and scatter over the replicates.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// The whole file; `group` is the number of the group's row in groups.csv, from 1, and `curve` is
///   pair_correlation  g at a distance from low to high, d
///   force_density     probability density of contact forces over the mean of their layer
std::string distributions_csv(const std::vector<Group>& groups);

}  // namespace grainsweep
