// How many jobs a sweep may have, said before any is made.
#pragma once

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

/// Notes blocks that are too large alone or together; true if there is room for all.
bool fits(const SweepDefinition& definition, Diagnostics& diagnostics);

}  // namespace grainsweep
