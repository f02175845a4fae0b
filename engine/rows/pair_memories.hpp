// What pairs remember from one list of candidates to the next.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/context.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// The pairs of a list by their first grain, as numbers in the list.
struct PairsByGrain {
  std::vector<std::int32_t> begin;   ///< where those of each grain begin in `number`; one more
  std::vector<std::int32_t> number;  ///< those of a grain in the order of the list

  /// Sorts the pairs of a list, a < b, of so many grains: a counting sort.
  void assign(std::size_t grains, const std::vector<GrainPair>& pairs) {
    begin.assign(grains + 1, 0);
    for (const GrainPair pair : pairs) ++begin[static_cast<std::size_t>(pair.a)];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    number.resize(pairs.size());
    for (std::size_t k = pairs.size(); k-- > 0;) {
      number[static_cast<std::size_t>(--begin[static_cast<std::size_t>(pairs[k].a)])] =
          static_cast<std::int32_t>(k);
    }
  }
  std::span<const std::int32_t> of(std::size_t grain) const {
    return std::span(number).subspan(static_cast<std::size_t>(begin[grain]),
                                     static_cast<std::size_t>(begin[grain + 1] - begin[grain]));
  }
};

inline constexpr std::int32_t not_listed = -1;

/// Kept from call to call.
struct PairMemoryColumns {
  std::vector<GrainPair> pairs;      ///< those of the list before
  std::vector<std::int32_t> before;  ///< see match_pairs
  PairsByGrain old, now;             ///< memory: of the list before, and of the new one
};

/// Finds each pair of a new list in the list before, columns.pairs: sets columns.before to its
/// number there, or to `not_listed`.
inline void match_pairs(std::size_t grains, const std::vector<GrainPair>& pairs,
                        const ParallelFor& loop, PairMemoryColumns& columns) {
  constexpr std::size_t grains_of_part = 4096;
  columns.old.assign(grains, columns.pairs);
  columns.now.assign(grains, pairs);
  columns.before.resize(pairs.size());
  parallel_chunks(loop, grains, grains / grains_of_part + 1, [&](std::size_t, IndexRange some) {
    std::vector<std::int32_t> number_with(grains, not_listed);  // of one grain: by its partner
    const auto partner = [](const std::vector<GrainPair>& list, std::int32_t k) {
      return static_cast<std::size_t>(list[static_cast<std::size_t>(k)].b);
    };
    for (std::size_t i = some.first; i < some.last; ++i) {
      const std::span<const std::int32_t> old = columns.old.of(i);
      for (const std::int32_t k : old) number_with[partner(columns.pairs, k)] = k;
      for (const std::int32_t k : columns.now.of(i)) {
        columns.before[static_cast<std::size_t>(k)] = number_with[partner(pairs, k)];
      }
      for (const std::int32_t k : old) number_with[partner(columns.pairs, k)] = not_listed;
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
