// Beds that will probably come out too low to be measured: every rule lets them pass, since grains
// may lie more loosely, and hours later they fail.
#pragma once

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// A note for each block that has such beds: how many, and how to mend them. Takes a third of the
/// time that reading the sweep took.
Diagnostics notes_on_low_beds(const Sweep& sweep);

}  // namespace grainsweep
