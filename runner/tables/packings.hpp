// packings.csv: one row per packing, in the sweep's order.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runner/tables/columns.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep {

/// A packing and the group it belongs to.
struct PackingLine {
  const Row& row;
  const Group& group;
};

/// The columns of a sweep. `coordination` counts at `gap_tolerance`; columns coordination_at_<gap>
/// hold the other tolerances of its jobs, in d, given ascending. A packing that is pending or
/// failed has empty cells where nothing was measured. Only cpu_seconds may differ between two runs.
Columns<PackingLine> packings_columns(const std::vector<double>& further_tolerances,
                                      const Varied& varied, const GivenUnits& units = {});

/// Gives `write` the file, a line at a time. `groups` are those of the rows.
void write_packings_csv(const std::vector<Row>& rows, const std::vector<Group>& groups,
                        const GivenUnits& units,
                        const std::function<void(const std::string&)>& write);

}  // namespace grainsweep
