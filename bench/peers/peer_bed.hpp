// The bed that grainsweep and its peers settle side by side.
#pragma once

#include "engine/scene/spec.hpp"

namespace grainsweep::bench {

/// Spheres of one size class between walls 5 d apart, periodic along x, with 20 grains per d^2 of
/// floor: 2000 grains make a box 20 d long. `seed` chooses sizes and places.
inline PackingSpec peer_bed(std::int64_t grains, std::uint64_t seed) {
  PackingSpec spec;
  spec.box.width = 5.0;
  spec.box.length = static_cast<double>(grains) / 100.0;
  spec.fill = GrainCount{grains};
  spec.random_key = seed;
  return spec;
}

}  // namespace grainsweep::bench
