// The parts of a sweep that no shards divide further.
#pragma once

#include <vector>

#include "engine/cost.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// The shard of every job, from 1, a growing group in one of them, and a family whose fit grows,
/// too; as `split` but for that.
std::vector<int> shards_of(const Sweep& whole, int shards);

}  // namespace grainsweep
