// What pairs remember from one list of candidates to the next.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/broad/pair_index.hpp"
#include "engine/context.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Kept from call to call.
struct PairMemoryColumns {
  std::vector<GrainPair> pairs;      ///< those of the list before
  std::vector<std::int32_t> before;  ///< see match_pairs
  PairIndex index;                   ///< memory: of `pairs`
};

/// Finds each pair of a new list in the list before, columns.pairs: sets columns.before to its
/// number there, or to PairIndex::none.
inline void match_pairs(std::size_t grains, const std::vector<GrainPair>& pairs,
                        const ParallelFor& loop, PairMemoryColumns& columns) {
  columns.index.assign(grains, columns.pairs);
  columns.before.resize(pairs.size());
  parallel_items(loop, pairs.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) {
      columns.before[k] = columns.index.number_of(pairs[k]);
    }
  });
}

/// Gives the pairs of the new list what those of the list before remembered in `memory`, which then
/// belongs to the new pairs. Pairs that were not listed before remember `nothing`. `spare`: memory.
template <class Memory>
void keep_memories(const PairMemoryColumns& columns, const ParallelFor& loop, const Memory& nothing,
                   std::vector<Memory>& memory, std::vector<Memory>& spare) {
  std::swap(memory, spare);
  memory.resize(columns.before.size());
  parallel_items(loop, memory.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) {
      const std::int32_t before = columns.before[k];
      memory[k] = before != PairIndex::none ? spare[static_cast<std::size_t>(before)] : nothing;
    }
  });
}

}  // namespace grainsweep
