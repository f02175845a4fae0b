// The parts of a sweep that are not divided further among shards.
#pragma once

#include <vector>

#include "engine/cost.hpp"
#include "runner/jobs/growing_families.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// What is made by one shard: a packing, a growing group, or a family whose fit grows.
struct Part {
  Places first;  ///< those of its jobs that are made at first
  Places later;  ///< those that it may grow by
  Cost cost;     ///< what the first ones take together, and the largest bytes of one
};

/// The parts of a sweep; every job is in one of them. `costs`: those of its jobs.
std::vector<Part> parts_of(const Sweep& whole, const std::vector<Cost>& costs);

/// The shard of every part, from 1, as `split` divides them.
std::vector<int> shards_of(const std::vector<Part>& parts, int shards);

/// The shard of every job, from 1: as `split` divides them, but with parts kept whole.
std::vector<int> shards_of(const Sweep& whole, int shards);

}  // namespace grainsweep
