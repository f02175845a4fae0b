// Two convex shapes by brute force in long double: every vertex against every face, every edge
// against every edge, every axis that could part them. The oracle of narrow phase.
#pragma once

#include "engine/narrow/shape_pair.hpp"

namespace grainsweep::testing {

struct PairTruth {
  bool overlap = false;
  long double distance = 0;  ///< between shapes apart, from closest features, d
  long double depth = 0;     ///< for overlapping ones: the shortest translation that parts them, d
  /// Largest separation over the faces, and the edges at an angle of more than 1e-3, d.
  long double separation = 0;

  /// Distance, or minus depth.
  long double gap() const { return overlap ? -depth : distance; }
};

/// Everything about a pair, from its vertices and the corners of its faces alone.
PairTruth true_gap(const ShapePair& pair);

}  // namespace grainsweep::testing
