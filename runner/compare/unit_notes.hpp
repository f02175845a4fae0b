// Published lengths that seem to be in the unit of the sweep, where files have them in d.
#pragma once

#include <string>
#include <vector>

#include "runner/compare/reference.hpp"
#include "runner/sweep/units.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

/// A note, a line long, for each width and each range of a formula that no packing has in d but
/// would have if it were in the unit of the sweep, and for each profile whose points would end
/// before the middle then and lie beyond it in d.
std::string notes_on_lengths(const Reference& reference, const std::vector<Family>& families,
                             const Units& units);

}  // namespace grainsweep
