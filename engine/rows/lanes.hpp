// Which lane of which block a contact goes into, so that no two lanes of a block share a grain.
//
// A contact takes the first open block that holds neither of its grains: neighbours in space stay
// neighbours in memory. A block is closed when it is full, or to make room for another one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/kernels.hpp"

namespace grainsweep {

/// Lane of a block.
struct BlockLane {
  std::size_t block = 0, lane = 0;
};

class OpenBlocks {
 public:
  /// Side of a contact that is not a grain, and may be in a block any number of times.
  static constexpr std::int32_t no_grain = -1;

  /// `words`: one per grain, 0 for grains that are going to be in contacts; these words are 0 again
  /// after `close_all`.
  explicit OpenBlocks(std::vector<std::uint64_t>& words) : words_(words) {}

  /// A lane for the contact of a with b. `append` appends a void block and returns its number.
  template <class Append>
  BlockLane take(std::int32_t a, std::int32_t b, const Append& append) {
    if ((word(a) | word(b)) == ~std::uint64_t{0}) close(fullest());
    const auto slot = static_cast<std::size_t>(__builtin_ctzll(~(word(a) | word(b))));
    if (used_[slot] == 0) block_[slot] = append();
    const BlockLane taken{block_[slot], used_[slot]};
    sides_[slot][used_[slot]++] = {a, b};
    mark(a, slot);
    mark(b, slot);
    if (used_[slot] == block_width) close(slot);
    return taken;
  }

  void close_all() {
    for (std::size_t slot = 0; slot < max_open; ++slot) close(slot);
  }

 private:
  static constexpr std::size_t max_open = 64;  // blocks filled at the same time: bits of a word
  struct Sides {
    std::int32_t a, b;
  };

  std::uint64_t word(std::int32_t grain) const {
    return grain == no_grain ? 0 : words_[static_cast<std::size_t>(grain)];
  }
  void mark(std::int32_t grain, std::size_t slot) {
    if (grain != no_grain) words_[static_cast<std::size_t>(grain)] |= std::uint64_t{1} << slot;
  }
  void forget(std::int32_t grain, std::size_t slot) {
    if (grain != no_grain) words_[static_cast<std::size_t>(grain)] &= ~(std::uint64_t{1} << slot);
  }
  void close(std::size_t slot) {
    for (std::size_t lane = 0; lane < used_[slot]; ++lane) {
      forget(sides_[slot][lane].a, slot);
      forget(sides_[slot][lane].b, slot);
    }
    used_[slot] = 0;
  }
  std::size_t fullest() const {
    return static_cast<std::size_t>(std::max_element(used_, used_ + max_open) - used_);
  }

  std::vector<std::uint64_t>& words_;  // one bit for each open block that holds the grain
  std::size_t block_[max_open] = {};
  std::size_t used_[max_open] = {};
  Sides sides_[max_open][block_width] = {};
};

}  // namespace grainsweep
