// Starts from the beds that packings end as.
#pragma once

#include "engine/packing.hpp"

namespace grainsweep::testing {

/// The grains of a packing as it gives them back.
inline PlacedGrains placed_as_in(const Packing& packing) {
  PlacedGrains placed;
  for (const SettledGrain& grain : packing.grains) {
    placed.grains.push_back({grain.x, grain.y, grain.z, grain.radius});
  }
  if (packing.turned) {
    placed.orientations = packing.turned->orientations;
    placed.components = packing.turned->components;
  }
  return placed;
}

}  // namespace grainsweep::testing
