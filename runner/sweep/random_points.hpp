// Random points of a sweep, from counter-based random numbers.
//
// A draw is Philox4x64-10 of the counter (block, point, hash of the path, 0) under the key (master
// seed, a constant of this file): it depends on nothing else, so editing one block, or adding a
// path to it, leaves all other draws as they are. `block` counts from 0 in the order of the file:
// append new blocks at the end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runner/sweep/assignments.hpp"

namespace grainsweep {

enum class Distribution { uniform, log_uniform, choice };

/// What a random path is drawn from.
struct RandomPath {
  std::string path;     ///< "box.width"
  std::string pointer;  ///< where it is written
  Distribution distribution = Distribution::uniform;
  std::size_t parameter = 0;         ///< of uniform and log_uniform: a number or a whole number
  double low = 0.0, high = 0.0;      ///< bounds, both possible; whole numbers are rounded to
  std::vector<Assignments> choices;  ///< of choice
};

/// Which draw: the `point`th of block `block` under master seed `seed`.
struct DrawKey {
  std::uint64_t seed = 0, block = 0, point = 0;
};

/// Uniform in [0, 1) with 53 random bits.
double uniform_draw(const DrawKey& key, const std::string& path);

/// One point of `random`. Numbers carry nine significant digits: they read well and do not depend
/// on the last bit of a logarithm.
Assignments draw(const RandomPath& random, const DrawKey& key);

}  // namespace grainsweep
