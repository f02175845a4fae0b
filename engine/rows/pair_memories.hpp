// What pairs remember from one list of candidates to the next.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/context.hpp"
#include "engine/rows/contacts.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// A pair of a list, as one of its first grain.
struct ListedPair {
  std::int32_t partner = 0;
  std::int32_t number = 0;  ///< in the list
};

inline constexpr std::int32_t not_listed = -1;

/// Kept from call to call.
struct PairMemoryColumns {
  std::vector<GrainPair> pairs;      ///< those of the list before
  std::vector<std::int32_t> before;  ///< see match_pairs
  ByGrain<ListedPair> old, now;      ///< memory: `pairs` and the new list, by first grain
};

inline void sort_by_grain(std::size_t grains, const std::vector<GrainPair>& pairs,
                          ByGrain<ListedPair>& sorted) {
  const auto visit_all = [&](const auto& put) {
    std::int32_t number = 0;
    for (const GrainPair pair : pairs) put(pair.a, ListedPair{pair.b, number++});
  };
  collect(grains, visit_all, sorted);
}

/// Finds each pair of a new list in the list before, columns.pairs: sets columns.before to its
/// number there, or to `not_listed`.
inline void match_pairs(std::size_t grains, const std::vector<GrainPair>& pairs,
                        const ParallelFor& loop, PairMemoryColumns& columns) {
  constexpr std::size_t grains_of_part = 4096;
  sort_by_grain(grains, columns.pairs, columns.old);
  sort_by_grain(grains, pairs, columns.now);
  columns.before.resize(pairs.size());
  parallel_chunks(loop, grains, grains / grains_of_part + 1, [&](std::size_t, IndexRange some) {
    std::vector<std::int32_t> number_with(grains, not_listed);  // of one grain: by its partner
    const auto with = [&](ListedPair pair) -> std::int32_t& {
      return number_with[static_cast<std::size_t>(pair.partner)];
    };
    for (std::size_t i = some.first; i < some.last; ++i) {
      const auto grain = static_cast<std::int32_t>(i);
      for (const ListedPair pair : columns.old.of(grain)) with(pair) = pair.number;
      for (const ListedPair pair : columns.now.of(grain)) {
        columns.before[static_cast<std::size_t>(pair.number)] = with(pair);
      }
      for (const ListedPair pair : columns.old.of(grain)) with(pair) = not_listed;
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
      memory[k] = before != not_listed ? spare[static_cast<std::size_t>(before)] : nothing;
    }
  });
}

}  // namespace grainsweep
