// From the blocks of a sweep to its jobs.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep {

/// The jobs of `definition`: block by block, in a block point by point (the last path of a grid
/// changes faster than the ones before it, then its zip, then its random points), in a point
/// replicate by replicate. A job that two blocks of the same label share is made once. Paths of
/// files of grains and of vertices are relative to `folder`.
///
/// Notes as diagnostics: more than `most_jobs` jobs, before any is made; every rule of `check` that
/// a point breaks, at the place of the value, once, with the point where that matters; files that
/// cannot be read; and jobs that two blocks of different labels share. If there is any problem, the
/// jobs must not be used.
std::vector<Job> expand(const SweepDefinition& definition, const std::string& folder,
                        Diagnostics& diagnostics);

}  // namespace grainsweep
