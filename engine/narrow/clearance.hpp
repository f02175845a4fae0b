// Pairs that are apart are not looked at again before their grains have moved far enough to meet.
//
// A grain's path is a bound of how far any of its points has moved, and how far its turns have moved
// the points of a neighbour as it sees them. Two grains that were parted by s are parted by s less
// what both paths have grown since, along the same direction as the first of them sees it. So a pair
// that is left alone has no contact, and would have been found to have none.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "engine/context.hpp"
#include "engine/scene/bed.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

struct GrainPaths {
  static constexpr double widest = 0.25;  ///< largest margin of contacts that paths are for, d

  std::vector<double> path;  ///< of each grain, d
  double largest = 0.0;      ///< circumradius, d
  double period = std::numeric_limits<double>::infinity();  ///< the shorter one of the box, d
  std::vector<Record<double>> centre, orientation;          ///< when they were followed last
};

/// Adds what the grains have moved since the last call. The paths of a bed of another number of
/// grains begin anew, at 0.
void follow(const PolyhedronBed& bed, const ParallelFor& loop, GrainPaths& paths);

/// Of the pairs of a list: up to which sum of their paths they are apart, d; 0: not known.
class Clearances {
 public:
  /// Both must outlive it.
  Clearances(const GrainPaths& paths, std::span<double> until) : paths_(paths), until_(until) {}

  /// Whether pair k of the list is surely further apart than `margin`.
  bool is_clear(std::size_t k, GrainPair pair, double margin) const {
    constexpr double rounding = 1e-9;  // of sums of paths, d
    return margin <= GrainPaths::widest && walked(pair) + margin + rounding < until_[k];
  }
  /// Pair k is parted by `separation`, d, and the distance of its centres is that. No other image of
  /// the second grain may come as near before the pair is looked at again.
  void set(std::size_t k, GrainPair pair, double separation, double distance) {
    const double near = 2.0 * paths_.largest + GrainPaths::widest;
    if (distance > near) return;
    until_[k] = walked(pair) + std::min(separation, paths_.period - near - distance);
  }

 private:
  double walked(GrainPair pair) const {
    return paths_.path[static_cast<std::size_t>(pair.a)] +
           paths_.path[static_cast<std::size_t>(pair.b)];
  }

  const GrainPaths& paths_;
  std::span<double> until_;
};

}  // namespace grainsweep
