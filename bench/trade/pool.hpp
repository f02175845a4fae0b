// Rows of a scene from several runs with starts of their own: what none of them can afford at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/trade/comparison.hpp"

namespace grainsweep::bench {

/// Means over the starts of both, which have none in common; one without pairs adds nothing.
MeanError pooled(const MeanError& a, const MeanError& b);

/// Stores `rows` in the file under the seed of their starts, in place of earlier rows of that seed;
/// a file that is not there is made. Each of `rows` becomes the mean over all starts that the file
/// has of its accuracy, with as many pairs and beds; one that lacks a seed of which the reference
/// has beds becomes a difference of means. CPU times, which depend on the machine, are means over
/// the seeds, by beds made. Throws FileError if the file cannot be read or written,
/// std::runtime_error if it is of another scene or not of this kind.
void pool_with(const std::string& path, const Scene& scene, std::vector<Compared>& rows);

}  // namespace grainsweep::bench
