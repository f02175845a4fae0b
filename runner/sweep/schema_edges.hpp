// The edges of what can be packed, where the engine's check refuses a packing for two or three of
// its values together. A JSON Schema neither compares nor computes, but it can hold steps along
// such an edge: from this length on, no less than this width.
#pragma once

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// Rules for a whole sweep, all of which hold. If a sweep breaks one, check() refuses every packing
/// that it makes; some packings that check() refuses lie between two steps.
Json edge_rules();

}  // namespace grainsweep
