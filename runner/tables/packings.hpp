// packings.csv: one row per packing, in the sweep's order.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// The whole file. `coordination` counts at `gap_tolerance`; the columns coordination_at_<gap> hold
/// the other tolerances of the sweep, in d. The last columns, of runner/tables/shape_columns.hpp,
/// are empty for spheres. A packing that is pending or failed has empty cells where nothing was
/// measured. Only cpu_seconds may differ between two runs of a sweep.
std::string packings_csv(const std::vector<Row>& rows);

}  // namespace grainsweep
