// Which grains touch: the pairs and walls whose gap is below a tolerance, measured in f64.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

struct TouchingPair {
  std::int32_t a, b;  ///< grains, a < b
  double gap;         ///< d, negative = overlap
};
struct TouchingWall {
  std::int32_t grain;
  std::int32_t wall;  ///< of the bed's walls: 0 is the floor
  double gap;         ///< d
};

struct Touching {
  std::vector<TouchingPair> pairs;
  std::vector<TouchingWall> walls;
};

/// Calls pair(grain, other) for each of two grains with a gap below `gap_tolerance`, d, and
/// wall(grain) for each wall within the same gap of a grain.
template <class Pair, class Wall>
void visit_touching(const Touching& touching, double gap_tolerance, const Pair& pair,
                    const Wall& wall) {
  for (const TouchingPair& one : touching.pairs) {
    if (!(one.gap < gap_tolerance)) continue;
    pair(static_cast<std::size_t>(one.a), static_cast<std::size_t>(one.b));
    pair(static_cast<std::size_t>(one.b), static_cast<std::size_t>(one.a));
  }
  for (const TouchingWall& one : touching.walls) {
    if (one.gap < gap_tolerance) wall(static_cast<std::size_t>(one.grain));
  }
}

/// All pairs and walls with a gap below a tolerance, d. Gaps of polyhedra are the distances of
/// their surfaces or, where they overlap, minus the shortest translation that parts them. Wraps the
/// bed. The tolerance of spheres may depend on the radii of the two, infinite ones for walls: this
/// makes lists of small grains far shorter.
template <class Kind>
Touching find_touching(Bed<Kind>& bed, const PairReach& tolerance_of, const Kernels& kernels);

/// The same with one tolerance for all.
template <class Kind>
Touching find_touching(Bed<Kind>& bed, double gap_tolerance, const Kernels& kernels) {
  return find_touching(bed, PairReach([=](double, double) { return gap_tolerance; }), kernels);
}
}  // namespace grainsweep
