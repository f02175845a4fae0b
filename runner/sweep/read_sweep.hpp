// From a sweep file to its jobs, or to everything that is wrong with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

struct SweepReading {
  Sweep sweep;                     ///< meaningful only if `errors` is empty
  std::vector<Diagnostic> errors;  ///< all of them, in the order of the file
  std::vector<Diagnostic> notes;   ///< of a sweep without errors: what is written and never used
};

/// Finds what else is wrong with a sweep whose file is right, or worth a note.
using SweepCheck = std::function<Diagnostics(const Sweep&)>;

/// Reads and expands a sweep file, and looks at what `check` says of it. Never throws for bad
/// input: every error is a Diagnostic.
SweepReading read_sweep(const std::string& path, const SweepCheck& check = {});

}  // namespace grainsweep
