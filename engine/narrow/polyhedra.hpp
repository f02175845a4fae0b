// Which polyhedra of a list of pairs touch, and where.
//
// The chain of tests of a pair: how far its grains have moved since it was found apart; balls; then
// for pinacoids, of the same proportions or not, the batch test of separating axes and its best
// axes measured anew in f64, for other shapes the pair's last axis and separating axes; at last the
// contact polygon, every point of it, and GJK where no point shows that the pair is near
// (engine/narrow/manifold.hpp). Spheres touch at one point (engine/narrow/ball_pair.hpp). Walls
// touch with all vertices near them.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/narrow/manifold.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Grains a and b of a bed, which must outlive it, b at its nearest image.
inline ShapePair shape_pair(const PolyhedronBed& bed, std::size_t a, std::size_t b) {
  return {bed.shape(a), bed.shape(b), pair_pose(bed, a, b)};
}

/// Contact of grain a with grain b > a, or with the wall of that name (Grains::wall_name). Its
/// points are `points[first]` .. `points[first + count - 1]`.
struct PolyhedronContact {
  std::int32_t a = 0, b = 0;
  AxisKind kind = AxisKind::none;  ///< what gave the normal; none = a wall
  Vector normal = Vector::Zero();  ///< unit, from a to b, frame of a
  std::size_t first = 0, count = 0;
  PairPose pose;  ///< grain b as a sees it; not set for a wall
  CrossedEdges edges = {};
  double parted = std::numeric_limits<double>::lowest();  ///< of a pair; see PairContact
};

struct ContactList {
  std::vector<PolyhedronContact> contacts;  ///< pairs in the order of their list, then the walls
  std::vector<ContactPoint> points;         ///< positions about the centre of a, frame of a

  void clear() {
    contacts.clear();
    points.clear();
  }
};

/// A pair whose balls meet.
struct ClosePair {
  std::uint32_t number = 0;  ///< in the list of pairs
  std::uint32_t lane = 0;    ///< of the blocks of the batch test, or `no_lane`
  double squared = 0.0;      ///< distance of the centres, d^2
  static constexpr std::uint32_t no_lane = 0xFFFFFFFF;
};

/// Which pairs need not be looked at: those that were found apart, and whose grains have since
/// moved less than would bring them together.
struct FarPairs {
  std::span<const double> travel;  ///< of each grain, d; see engine/rows/travel.hpp
  /// For each pair, the summed travel of its two grains from which on they may touch, d; less than
  /// any travel if they have not been looked at.
  std::span<double> until;

  double travel_of(GrainPair pair) const {
    return travel[static_cast<std::size_t>(pair.a)] + travel[static_cast<std::size_t>(pair.b)];
  }
};

/// Working memory, kept from call to call.
struct NarrowColumns {
  std::vector<ClosePair> close;     ///< pairs whose balls are near each other
  std::vector<PinacoidBlock> axes;  ///< what the batch test says of them
  TouchColumns touch;
};

/// Whether pairs of the bed have a PairMemory: those of pinacoids have none.
bool needs_memory(const PolyhedronBed& bed);

/// Appends the contacts of `pairs`; `far` says which are none, and is told of others; `memory` is
/// what each of them remembers, if any does. Both save time and change nothing. Returns the most by
/// which centres are nearer than sunk_share of the distance at which the balls within their grains
/// touch, d; 0 if none are.
double touch_pairs(const TouchSettings& settings, const Kernels& kernels, const PolyhedronBed& bed,
                   std::span<const GrainPair> pairs, FarPairs far, std::span<PairMemory> memory,
                   NarrowColumns& columns, ContactList& found);

/// Appends the contacts of grains with wall k of the bed. A round wall is concave, so that only
/// vertices touch it: vertex v of a grain has a contact of its own, with the name wall_name(k) + v.
void touch_wall(std::size_t k, const std::vector<std::int32_t>& grains, double margin,
                const PolyhedronBed& bed, ContactList& found);

}  // namespace grainsweep
