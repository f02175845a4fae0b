// The member "units" of a sweep file.
#pragma once

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/units.hpp"

namespace grainsweep {

/// None if the file has no such member, or a wrong one, which is noted.
GivenUnits read_units(const Json& file, Diagnostics& diagnostics);

}  // namespace grainsweep
