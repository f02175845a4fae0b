// Which presets were taken where an accuracy is asked for, and why.
#pragma once

#include <string>

#include "runner/sweep/job.hpp"

namespace grainsweep {

/// A line for each preset, kind of bed and requested accuracy, in the sweep's order; empty if the
/// sweep requests none.
std::string chosen_presets_text(const Sweep& sweep);

}  // namespace grainsweep
