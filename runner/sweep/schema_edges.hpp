// The edges of what can be packed, where the engine's check refuses a packing for two or three of
// its values together. A JSON Schema neither compares nor computes, but it can hold steps along
// such an edge: from this length on, no less than this width.
#pragma once

#include "runner/sweep/values.hpp"

namespace grainsweep {

/// Of a whole sweep: rules that all hold. A sweep that breaks one is refused by check() for every
/// packing it makes; of those that check() refuses some lie between two steps.
Json edge_rules();

}  // namespace grainsweep
