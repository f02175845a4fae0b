// Families of pairs of convex shapes: at random, and in every degenerate position.
#pragma once

#include <string>
#include <vector>

#include "engine/narrow/shape_pair.hpp"
#include "tests/support/pair_oracle.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep::testing {

enum class PairFamily {
  random,
  near_touching,
  parallel_faces,
  parallel_edges,
  vertex_on_vertex,
  deep_overlap,
  flat,
  far_away,
};

extern const std::vector<PairFamily> all_pair_families;

std::string name_of(PairFamily family);

/// Sizes and turns at random; centres `nearest` to `farthest` apart, d.
PairPose random_pose(Draw& draw, double nearest, double farthest);

PairPose pose_of_family(PairFamily family, Draw& draw, const ConvexShape& a, const ConvexShape& b);

}  // namespace grainsweep::testing
