// What computes a packing: the kernels of an instruction set, several cores for large beds, and the
// memory that the last packing has left.
//
// The engine starts no thread. It names parts of its work that may be done at the same time;
// whoever calls it says how. A bed is divided by its size alone, never by the number of cores, and
// parts that meet are joined in a fixed order: the bits are the same however the parts are spread.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include "kernels/kernels.hpp"

namespace grainsweep {

/// Calls part(0) .. part(parts - 1), in any order and maybe at the same time, and returns when all
/// are done.
using ParallelFor =
    std::function<void(std::size_t parts, const std::function<void(std::size_t)>& part)>;

inline void serial_for(std::size_t parts, const std::function<void(std::size_t)>& part) {
  for (std::size_t k = 0; k < parts; ++k) part(k);
}

/// Runs the parts of a function object without a copy of it, so that nothing is allocated.
template <class Part>
void parallel_for(const ParallelFor& loop, std::size_t parts, const Part& part) {
  if (parts == 1) {
    part(std::size_t{0});
  } else {
    loop(parts, std::cref(part));
  }
}

/// Items first .. last of a range.
struct IndexRange {
  std::size_t first, last;
};

/// Part `part` of `parts` of a range of `size` items.
inline IndexRange chunk_of(std::size_t size, std::size_t part, std::size_t parts) {
  return {size * part / parts, size * (part + 1) / parts};
}

/// Calls work(part, share) for all parts of a range of `size` items.
template <class Work>
void parallel_chunks(const ParallelFor& loop, std::size_t size, std::size_t parts,
                     const Work& work) {
  parallel_for(loop, parts, [&](std::size_t part) { work(part, chunk_of(size, part, parts)); });
}

/// Calls work(first, count) for `size` items that are little work each, some thousands at a time.
template <class Work>
void parallel_items(const ParallelFor& loop, std::size_t size, const Work& work) {
  constexpr std::size_t items_of_part = 8192;
  parallel_chunks(loop, size, size / items_of_part + 1, [&](std::size_t, IndexRange items) {
    work(items.first, items.last - items.first);
  });
}

struct Workspace;  // engine/dynamics/workspace.hpp

struct ExecutionContext {
  // With kernels alone: one core, and no memory of earlier packings.
  ExecutionContext(const Kernels& table, ParallelFor parts = serial_for, Workspace* used = nullptr)
      : kernels(table), loop(std::move(parts)), workspace(used) {}

  const Kernels& kernels;
  ParallelFor loop;
  Workspace* workspace;  ///< memory of the last packing, or none
};

}  // namespace grainsweep
