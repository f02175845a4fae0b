// What pairs remember from one list of candidates to the next.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/context.hpp"
#include "engine/rows/contacts.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Kept from call to call.
struct PairMemoryColumns {
  struct Partner {
    std::int32_t second;  ///< grain of a pair
    std::size_t number;   ///< of the pair
  };

  std::vector<GrainPair> pairs;     ///< those of the list before
  std::vector<std::size_t> before;  ///< see match_pairs
  ByGrain<Partner> partners;        ///< of each first grain, by the second ascending
  ByGrain<std::size_t> by_second;   ///< memory: the pairs, by their second grains
};
/// Finds each pair of a new list in the list before, columns.pairs: columns.before becomes its
/// number in it, or the number of its pairs if it was not listed.
void match_pairs(std::size_t grains, const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                 PairMemoryColumns& columns);

/// Gives the pairs of the new list what those of the list before remembered in `memory`, which is
/// then of the new ones. Pairs that were not listed remember `nothing`. `spare`: memory.
template <class Memory>
void keep_memories(const PairMemoryColumns& columns, const ParallelFor& loop, const Memory& nothing,
                   std::vector<Memory>& memory, std::vector<Memory>& spare) {
  std::swap(memory, spare);
  memory.resize(columns.before.size());
  parallel_items(loop, memory.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) {
      const std::size_t before = columns.before[k];
      memory[k] = before < columns.pairs.size() ? spare[before] : nothing;
    }
  });
}

}  // namespace grainsweep
