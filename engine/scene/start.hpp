// The start of a packing: grains loose in the air, none touching.
#pragma once

#include <optional>

#include "engine/scene/bed.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Solid fraction of the column in which grains are placed at random.
inline constexpr double start_solid_fraction = 0.25;

/// Grains of the given sizes placed one after the other at random where they overlap no other
/// (random sequential addition), in a column above the floor; or the user's own placed grains.
/// Grains are numbered from the floor up. Empty if a grain does not fit between the walls or no
/// room is found for it.
std::optional<SphereBed> start(const PackingSpec& spec);

}  // namespace grainsweep
