#include "engine/rows/pair_memories.hpp"

#include <algorithm>
#include <span>

namespace grainsweep {

namespace {

/// Lists the pairs before by their first grain, and those of each by the second.
void sort_by_grains(std::size_t grains, PairMemoryColumns& columns) {
  const std::vector<GrainPair>& pairs = columns.pairs;
  const auto visit_pairs = [&](const auto& put) {
    for (std::size_t k = 0; k < pairs.size(); ++k) put(pairs[k].b, k);
  };
  collect(grains, visit_pairs, columns.by_second);
  const auto visit_partners = [&](const auto& put) {
    for (const std::size_t k : columns.by_second.entries) {
      put(pairs[k].a, PairMemoryColumns::Partner{pairs[k].b, k});
    }
  };
  collect(grains, visit_partners, columns.partners);
}
/// Number of a pair in the list before; that of its pairs if it was not listed.
std::size_t number_before(GrainPair pair, const PairMemoryColumns& columns) {
  const std::span<const PairMemoryColumns::Partner> partners = columns.partners.of(pair.a);
  const auto at = std::lower_bound(partners.begin(), partners.end(), pair.b,
                                   [](const auto& one, std::int32_t b) { return one.second < b; });
  return at != partners.end() && at->second == pair.b ? at->number : columns.pairs.size();
}

}  // namespace

void match_pairs(std::size_t grains, const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                 PairMemoryColumns& columns) {
  sort_by_grains(grains, columns);
  columns.before.resize(pairs.size());
  parallel_items(loop, pairs.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) {
      columns.before[k] = number_before(pairs[k], columns);
    }
  });
}

}  // namespace grainsweep
