// Fills blocks of rows so that no two lanes of a block share a grain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/contact/contacts.hpp"

namespace grainsweep {

/// Appends blocks of void rows and hands out their lanes.
template <class Real>
class BlockWriter {
 public:
  /// `open_blocks`: one word per grain, 0 for those that are going to be in rows.
  BlockWriter(const SphereBed& bed, std::size_t section, std::vector<std::uint64_t>& open_blocks,
              RowColumns<Real>& columns)
      : bed_(bed), section_(section), open_blocks_(open_blocks), columns_(columns) {}

  /// Puts a pair into the first open block that holds neither of its grains, so that neighbours in
  /// space stay neighbours in memory.
  void add_pair(GrainPair pair, Real impulse) {
    std::uint64_t& a = open_blocks_[static_cast<std::size_t>(pair.a)];
    std::uint64_t& b = open_blocks_[static_cast<std::size_t>(pair.b)];
    if ((a | b) == ~std::uint64_t{0}) {
      close(fullest());
    }
    const auto slot = static_cast<std::size_t>(__builtin_ctzll(~(a | b)));
    a |= std::uint64_t{1} << slot;
    b |= std::uint64_t{1} << slot;
    open(slot);
    fill_lane(block_[slot], used_[slot]++, pair.a, pair.b, impulse);
    if (used_[slot] == block_width) {
      close(slot);
    }
  }

  /// Closes all blocks: the grains forget them.
  void finish_pairs() {
    for (std::size_t slot = 0; slot < most_open; ++slot) {
      if (used_[slot] > 0) {
        close(slot);
      }
    }
  }

  /// Rows of one wall in blocks of their own: no grain touches it twice, so lanes are filled in
  /// order.
  template <class ImpulseOf>
  void add_wall(const std::vector<std::int32_t>& grains, ImpulseOf impulse_of) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      if (k % block_width == 0) {
        append_void_block();
      }
      fill_lane(columns_.rows.size() - 1, k % block_width, grains[k], bed_.wall(),
                impulse_of(grains[k]));
    }
  }

 private:
  static constexpr std::size_t most_open = 64;  // blocks filled at the same time: bits of a word

  void open(std::size_t slot) {
    if (used_[slot] == 0) {
      block_[slot] = columns_.rows.size();
      append_void_block();
    }
  }
  void append_void_block() {
    columns_.rows.emplace_back();
    RowBlock<Real>& block = columns_.rows.back();
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.set_grains(lane, bed_.void_a(section_), bed_.void_b(section_));
    }
    std::fill(std::begin(block.reduced_mass), std::end(block.reduced_mass), Real(1));
    columns_.impulse.resize(columns_.rows.size() * block_width, Real(0));
  }
  void fill_lane(std::size_t block, std::size_t lane, std::int32_t a, std::int32_t b,
                 Real impulse) {
    columns_.rows[block].set_grains(lane, a, b);
    columns_.rows[block].reduced_mass[lane] = reduced_mass(a, b);
    columns_.impulse[block * block_width + lane] = impulse;
  }
  Real reduced_mass(std::int32_t a, std::int32_t b) const {
    return static_cast<Real>(1.0 / (bed_.motion[static_cast<std::size_t>(a)].w +
                                    bed_.motion[static_cast<std::size_t>(b)].w));
  }
  /// Makes room for a new block: the grains of the closed one forget it.
  void close(std::size_t slot) {
    const RowBlock<Real>& block = columns_.rows[block_[slot]];
    const std::uint64_t keep = ~(std::uint64_t{1} << slot);
    for (std::size_t lane = 0; lane < used_[slot]; ++lane) {
      open_blocks_[static_cast<std::size_t>(block.a(lane))] &= keep;
      open_blocks_[static_cast<std::size_t>(block.b(lane))] &= keep;
    }
    used_[slot] = 0;
  }
  std::size_t fullest() const {
    return static_cast<std::size_t>(std::max_element(used_, used_ + most_open) - used_);
  }

  const SphereBed& bed_;
  std::size_t section_;
  std::vector<std::uint64_t>& open_blocks_;
  RowColumns<Real>& columns_;
  std::size_t block_[most_open] = {};
  std::size_t used_[most_open] = {};
};

}  // namespace grainsweep
