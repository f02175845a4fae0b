#include "engine/rows/pair_memories.hpp"

#include <algorithm>
#include <utility>

namespace grainsweep {

namespace {

/// Lists the pairs before by their first grain.
void sort_by_first(std::size_t grains, PairMemoryColumns& columns) {
  columns.begin.assign(grains + 2, 0);
  for (const GrainPair& pair : columns.pairs) ++columns.begin[static_cast<std::size_t>(pair.a) + 2];
  for (std::size_t k = 2; k < columns.begin.size(); ++k) columns.begin[k] += columns.begin[k - 1];
  columns.by_first.resize(columns.pairs.size());
  for (std::size_t k = 0; k < columns.pairs.size(); ++k) {
    columns.by_first[columns.begin[static_cast<std::size_t>(columns.pairs[k].a) + 1]++] = k;
  }
}

}  // namespace

void keep_memories(std::size_t grains, const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                   std::vector<PairMemory>& memory, PairMemoryColumns& columns) {
  constexpr std::size_t pairs_of_part = 4000;
  std::swap(memory, columns.memory);
  sort_by_first(grains, columns);
  memory.assign(pairs.size(), {});
  parallel_for(loop, pairs.size() / pairs_of_part + 1, [&](std::size_t part) {
    const std::size_t end = std::min(pairs.size(), (part + 1) * pairs_of_part);
    for (std::size_t k = part * pairs_of_part; k < end; ++k) {
      const auto a = static_cast<std::size_t>(pairs[k].a);
      for (std::size_t i = columns.begin[a]; i < columns.begin[a + 1]; ++i) {
        const std::size_t before = columns.by_first[i];
        if (columns.pairs[before].b == pairs[k].b) memory[k] = columns.memory[before];
      }
    }
  });
}

}  // namespace grainsweep
