// What pairs remember from one list of candidates to the next.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/context.hpp"
#include "engine/narrow/manifold.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Kept from call to call.
struct PairMemoryColumns {
  std::vector<GrainPair> pairs;      ///< those of the list before
  std::vector<PairMemory> memory;    ///< of each of them
  std::vector<std::size_t> begin;    ///< of each first grain's in what follows; one more at the end
  std::vector<std::int32_t> second;  ///< second grains, of each first grain ascending
  std::vector<std::size_t> number;   ///< of their pairs
  std::vector<std::size_t> by_second;  ///< memory: the pairs, by their second grains
};

/// Gives the pairs of a new list what those of the list before, columns.pairs, remembered in
/// `memory`, which is then of the new ones. Pairs that were not listed remember nothing.
void keep_memories(std::size_t grains, const std::vector<GrainPair>& pairs, const ParallelFor& loop,
                   std::vector<PairMemory>& memory, PairMemoryColumns& columns);

}  // namespace grainsweep
