// The parts of a sweep that no shards divide further.
#pragma once

#include <vector>

#include "engine/cost.hpp"
#include "runner/jobs/growing_families.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// What is made by one shard: a packing, a growing group, or a family whose fit grows.
struct Part {
  Places first;  ///< of its jobs, those that are made at first
  Places later;  ///< those that it may grow by
  Cost cost;     ///< what the first ones take together, and the largest bytes of one
};

/// Every job of a sweep is in one of them. `costs`: of its jobs.
std::vector<Part> parts_of(const Sweep& whole, const std::vector<Cost>& costs);

/// The shard of every part, from 1, as `split` divides them.
std::vector<int> shards_of(const std::vector<Part>& parts, int shards);

/// The shard of every job, from 1: as `split`, but that parts remain whole.
std::vector<int> shards_of(const Sweep& whole, int shards);

}  // namespace grainsweep
