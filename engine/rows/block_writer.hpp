// Fills blocks of rows of spheres.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/rows/lanes.hpp"  // BlockLane
#include "engine/rows/sphere_contacts.hpp"

namespace grainsweep {

/// 1 / (1/m_a + 1/m_b), m, of the masses that resist motion.
template <class Real>
Real reduced_mass(const SphereBed& bed, std::int32_t a, std::int32_t b) {
  return static_cast<Real>(1.0 / (bed.inverse_inertia(a) + bed.inverse_inertia(b)));
}

/// Appends blocks of void rows of a subdomain and fills their lanes.
template <class Real>
class BlockWriter {
 public:
  BlockWriter(const SphereBed& bed, std::size_t subdomain, RowColumns<Real>& columns)
      : bed_(bed), subdomain_(subdomain), columns_(columns) {}

  /// The new block's number.
  std::size_t append_void_block() {
    columns_.rows.emplace_back();
    RowBlock<Real>& block = columns_.rows.back();
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      block.set_grains(lane, bed_.void_a(subdomain_), bed_.void_b(subdomain_));
    }
    std::fill(std::begin(block.reduced_mass), std::end(block.reduced_mass), Real(1));
    columns_.impulse.resize(columns_.rows.size() * block_width, Real(0));
    return columns_.rows.size() - 1;
  }
  /// The contact of grain a with grain b.
  void fill(BlockLane at, std::int32_t a, std::int32_t b, Real impulse) {
    columns_.rows[at.block].set_grains(at.lane, a, b);
    columns_.rows[at.block].reduced_mass[at.lane] = reduced_mass<Real>(bed_, a, b);
    columns_.impulse[at.block * block_width + at.lane] = impulse;
  }
  /// Rows of one flat wall in blocks of their own: no grain touches it twice, so lanes are filled
  /// in order.
  template <class ImpulseOf>
  void add_flat_wall(const std::vector<std::int32_t>& grains, ImpulseOf impulse_of) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      if (k % block_width == 0) append_void_block();
      fill({columns_.rows.size() - 1, k % block_width}, grains[k], bed_.wall(subdomain_),
           impulse_of(grains[k]));
    }
  }
  /// The same for a round wall: pairs of rows (kernels/row_kernels.hpp). `impulse_of(grain, axis)`:
  /// the impulse along x (0) or y (1).
  template <class ImpulseOf>
  void add_round_wall(const std::vector<std::int32_t>& grains, ImpulseOf impulse_of) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
      if (k % block_width == 0) append_void_pair();
      const std::size_t first = columns_.rows.size() - 2;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        fill({first + axis, k % block_width}, grains[k], bed_.wall(subdomain_),
             impulse_of(grains[k], axis));
      }
    }
  }

 private:
  void append_void_pair() {
    RowBlock<Real>& along_x = columns_.rows[append_void_block()];
    std::fill(std::begin(along_x.normal_x), std::end(along_x.normal_x), Real(-1));
    RowBlock<Real>& along_y = columns_.rows[append_void_block()];
    std::fill(std::begin(along_y.normal_y), std::end(along_y.normal_y), Real(-1));
  }

  const SphereBed& bed_;
  std::size_t subdomain_;
  RowColumns<Real>& columns_;
};

}  // namespace grainsweep
