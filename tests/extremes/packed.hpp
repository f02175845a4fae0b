// Whole packings as scenes: from a specification, as a job of a sweep is made.
#pragma once

#include "engine/packing.hpp"
#include "tests/extremes/judge.hpp"

namespace grainsweep::extremes {

using Spheres = std::vector<PlacedSphere>;

/// The grains of a bed where they are.
Spheres spheres_of(const SphereBed& bed);

/// A specification of a small bed with a slab that begins at the floor and ends at the surface.
PackingSpec small_spec(std::int64_t grains, const Accuracy& accuracy);

/// Checks and makes a packing, and asks of it what holds for any bed at rest.
Finding pack(const PackingSpec& spec);

/// The same without the check: what becomes of input that no rule has seen.
Finding pack_unchecked(const PackingSpec& spec);

}  // namespace grainsweep::extremes
