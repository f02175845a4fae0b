// distributions.csv: curves of each group, a row per point, mean and scatter over the replicates.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// The first line of the file.
std::string distributions_header();
/// Those of a group; `number` is that of the group's row in groups.csv, from 1. `curve` is
///   pair_correlation  g at a distance from low to high, d
///   force_density     probability density of contact forces over the mean of their layer
std::string distribution_lines(const Group& group, std::size_t number);

}  // namespace grainsweep
