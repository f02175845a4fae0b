// Beds that will probably come out too low to be measured: every rule lets them pass, since grains
// may lie more loosely, and hours later they fail.
#pragma once

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

/// A note for each block of `definition` that has such beds among the `jobs`: how many, and what
/// of them.
Diagnostics notes_on_low_beds(const SweepDefinition& definition, const std::vector<Job>& jobs);

}  // namespace grainsweep
