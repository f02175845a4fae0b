#include "engine/rows/pair_memories.hpp"

#include <algorithm>
#include <numeric>

namespace grainsweep {

namespace {

/// Sets begin[g + 1] to where the entries of grain g go among all in the order of their grains;
/// counted up with each that is put there, begin[g] is where those of g begin. `grain_of` tells the
/// grain of each of the entries.
template <class GrainOf>
void make_room(std::size_t grains, std::size_t entries, GrainOf grain_of,
               std::vector<std::size_t>& begin) {
  begin.assign(grains + 2, 0);
  for (std::size_t k = 0; k < entries; ++k) ++begin[grain_of(k) + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
}

/// Lists the pairs before by their first grain, and those of each by the second.
void sort_by_grains(std::size_t grains, PairMemoryColumns& columns) {
  const std::vector<GrainPair>& pairs = columns.pairs;
  const auto first = [&](std::size_t k) { return static_cast<std::size_t>(pairs[k].a); };
  const auto second = [&](std::size_t k) { return static_cast<std::size_t>(pairs[k].b); };
  columns.by_second.resize(pairs.size());
  columns.second.resize(pairs.size());
  columns.number.resize(pairs.size());
  make_room(grains, pairs.size(), second, columns.begin);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    columns.by_second[columns.begin[second(k) + 1]++] = k;
  }
  make_room(grains, pairs.size(), first, columns.begin);
  for (const std::size_t k : columns.by_second) {
    const std::size_t at = columns.begin[first(k) + 1]++;
    columns.second[at] = pairs[k].b;
    columns.number[at] = k;
  }
}

/// Number of a pair in the list before; that of its pairs if it was not listed.
std::size_t number_before(GrainPair pair, const PairMemoryColumns& columns) {
  const auto a = static_cast<std::size_t>(pair.a);
  const auto first = columns.second.begin() + static_cast<std::ptrdiff_t>(columns.begin[a]);
  const auto last = columns.second.begin() + static_cast<std::ptrdiff_t>(columns.begin[a + 1]);
  const auto at = std::lower_bound(first, last, pair.b);
  return at != last && *at == pair.b
             ? columns.number[static_cast<std::size_t>(at - columns.second.begin())]
             : columns.pairs.size();
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
