// Oracles of the contact search: every pair of grains looked at, one by one.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "engine/broad/candidates.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep::testing {

using NamedPair = std::pair<std::int32_t, std::int32_t>;

/// Gap of two grains, d, the smallest over the images of each period up to three periods away.
double gap_of(const SphereBed& bed, std::int32_t a, std::int32_t b);

/// All pairs a < b with a gap below `reach`.
std::set<NamedPair> pairs_closer_than(const SphereBed& bed, double reach);

/// The pairs of a list; a pair listed twice, or not as a < b, fails the test.
std::set<NamedPair> listed_pairs(const Candidates& candidates);

/// Whether the list holds every pair and every wall contact with a gap below `reach`.
bool holds_all_closer_than(const SphereBed& bed, const Candidates& candidates, double reach);

}  // namespace grainsweep::testing
