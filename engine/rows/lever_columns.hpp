// Rows of grains that turn, as the solver works on them.
#pragma once

#include <vector>

#include "engine/rows/contacts.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// The impulse of lane k of points[i] is `impulse[i * block_width + k]`, in masses times d: the
/// force it stands for is impulse / dt^2, in m g.
template <class Real>
struct LeverColumns {
  std::vector<BodyBlock<Real>> blocks;
  std::vector<BodyPoints<Real>> points;
  RowShares shares;  ///< one part
  std::vector<Real> impulse;
  std::vector<Real> extrapolated;  ///< the solver's look-ahead impulses

  // As of Contacts; a block says itself where its impulses are.
  static const BodyKernels<Real>& kernels_of(const Kernels& all) { return body_kernels<Real>(all); }
  BodyRows<Real> rows_of(BlockRange range) const {
    return {blocks.data() + range.first, points.data()};
  }
  static std::size_t first_impulse(BlockRange) { return 0; }
};

}  // namespace grainsweep
