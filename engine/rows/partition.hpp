// How rows are shared out among cores.
//
// No two parts of a phase push the same grain; phases follow one another. Small beds are one part.
// Large beds have two phases, of every second subdomain each (subdomains.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/context.hpp"

namespace grainsweep {

/// Blocks of rows that follow one another.
struct BlockRange {
  std::size_t first = 0;
  std::size_t blocks = 0;
};

/// Rows that one core works on. Where there are two phases, the parts of each phase together name
/// all grains: a part names those whose rows are its own or of the other phase.
struct RowPart {
  std::size_t phase = 0;
  std::size_t first_range = 0, ranges = 0;  ///< in RowShares::ranges
  std::size_t first_grain = 0, grains = 0;  ///< in RowShares::grains
};

struct RowShares {
  std::vector<BlockRange> ranges;    ///< all blocks, by part
  std::vector<RowPart> parts;        ///< by phase
  std::vector<std::int32_t> grains;  ///< by subdomain, in a ring the first one's at both ends;
                                     ///< empty if there is one phase

  std::size_t phases() const { return parts.empty() ? 0 : parts.back().phase + 1; }
  void clear() {
    ranges.clear();
    parts.clear();
    grains.clear();
  }
};

/// Parts first .. last.
struct PhaseParts {
  std::size_t first, last;
};
inline PhaseParts parts_of_phase(const RowShares& shares, std::size_t phase) {
  const auto begins = [](const RowPart& part, std::size_t at) { return part.phase < at; };
  const auto begin = shares.parts.begin(), end = shares.parts.end();
  const auto first = std::lower_bound(begin, end, phase, begins);
  const auto last = std::lower_bound(first, end, phase + 1, begins);
  return {static_cast<std::size_t>(first - begin), static_cast<std::size_t>(last - begin)};
}

/// Calls work(range) for the ranges of a part, one after the other.
template <class Work>
void visit_ranges(const RowShares& shares, const RowPart& part, const Work& work) {
  for (std::size_t k = part.first_range; k < part.first_range + part.ranges; ++k) {
    work(shares.ranges[k]);
  }
}

/// Calls work(range) for all ranges, the parts of a phase at the same time, phase after phase.
template <class Work>
void visit_ranges(const RowShares& shares, const ParallelFor& loop, const Work& work) {
  for (std::size_t phase = 0; phase < shares.phases(); ++phase) {
    const PhaseParts parts = parts_of_phase(shares, phase);
    parallel_for(loop, parts.last - parts.first,
                 [&](std::size_t k) { visit_ranges(shares, shares.parts[parts.first + k], work); });
  }
}

}  // namespace grainsweep
