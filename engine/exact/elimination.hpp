// The order in which the grains of a bed are eliminated, so that the factors of its stiffness
// matrix stay sparse: nested dissection.
//
// Two grains are neighbours if they are a pair. A plane halves the bed; the fewest grains that part
// the halves, one of every two neighbours on different sides of the plane
// (engine/exact/vertex_cover.hpp), come last; what is left of each half is parted in the same way
// (George 1973). Of the planes across the three axes, the one whose halves are parted by the fewest
// grains is taken: where neighbours meet around a periodic box, they are parted at two places. The
// parting grains of all halvings are the nodes of a binary tree, and the factors of a node depend
// on those of its children alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/kernels.hpp"

namespace grainsweep {

/// Grains that are eliminated together. Their factors fill in between them and their border.
struct EliminationNode {
  static constexpr std::int32_t none = -1;

  std::array<std::int32_t, 2> children = {none, none};
  std::vector<std::int32_t> grains;
  std::vector<std::int32_t> border;  ///< grains eliminated later, in the order of elimination

  std::size_t size() const { return grains.size() + border.size(); }
};

/// Children come before their parents, the root last.
struct EliminationTree {
  std::vector<EliminationNode> nodes;
  std::vector<std::int32_t> place;    ///< of each grain in the order of elimination
  std::vector<std::int32_t> node_of;  ///< of each grain
};

/// The tree of the grains with these centres and the pairs between them.
EliminationTree dissect(std::span<const Record<double>> centres,
                        const std::vector<GrainPair>& pairs);

}  // namespace grainsweep
