// The exact search for the best separating axes: every face, every pair of edges, none left out.
#pragma once

#include "engine/narrow/separating_axes.hpp"

namespace grainsweep::testing {

/// The best face, and the best pair of distinct edge directions if it parts the shapes better than
/// that, f64. For separate shapes these include edges whose axis is no normal of the difference of
/// the shapes; for overlapping ones such an axis is never the best.
ContactAxes all_axes(const ShapePair& pair);

}  // namespace grainsweep::testing
