// The start of a packing: grains loose in the air, none touching.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Solid fraction of the column in which grains are placed at random.
inline constexpr double start_solid_fraction = 0.25;

/// Grains of the given sizes placed one after the other at random where they overlap no other
/// (random sequential addition), in a column above the floor; or the user's own placed grains.
/// Grains are numbered from the floor up, those of large flat beds along x or y first. Empty if a
/// grain does not fit between the walls or no room is found for it.
std::optional<SphereBed> start(const PackingSpec& spec);

/// Spheres of these radii, at least one, placed in the same way in a column from the floor to
/// `height`, d, or to one and a half of the largest diameter. Sorted from the floor up.
std::optional<std::vector<PlacedSphere>> place_at_random(const Box& box,
                                                         const std::vector<double>& radii,
                                                         double height, std::uint64_t key);

}  // namespace grainsweep
