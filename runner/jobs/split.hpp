// A sweep divided among runners that know nothing of each other.
#pragma once

#include <vector>

#include "engine/cost.hpp"

namespace grainsweep {

/// For each of `costs` the number, from 1, of the shard that it belongs to: the longest first, each
/// to the shard that has least so far. The same on every machine: costs count in whole
/// microseconds, so that neither their last bits nor the order of a sum matter.
std::vector<int> split(const std::vector<Cost>& costs, int shards);

}  // namespace grainsweep
