// What the packings of a sweep will take, each by itself.
#pragma once

#include <vector>

#include "engine/cost.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// The estimate of each job, in their order: the same on every machine, so that a sweep can be
/// divided by it. Jobs of equal parameters are estimated once, except those that start from given
/// positions, which may differ from job to job.
std::vector<Cost> costs_of(const std::vector<const Job*>& jobs);
std::vector<Cost> costs_of(const std::vector<Job>& jobs);

}  // namespace grainsweep
