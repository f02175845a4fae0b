// What the packings of a sweep will take, each by itself.
#pragma once

#include <vector>

#include "engine/cost.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// The estimate of each job, in their order: the same on every machine, so that a sweep can be
/// divided by it. Jobs of equal parameters are estimated once, but for those that start from
/// positions, which may be other ones each.
std::vector<Cost> costs_of(const std::vector<const Job*>& jobs);
std::vector<Cost> costs_of(const std::vector<Job>& jobs);

}  // namespace grainsweep
