// What the kernel sources share: batches of the instruction set they are compiled for, joined to
// the fixed logical width of a block.
//
// GRAINSWEEP_ARCH_HEADER names the file of kernels/arch to compile with; everything lives in an
// unnamed namespace, so that no code of one instruction set can be linked into another.
#pragma once

#include <cstddef>
#include <cstdint>

#include <xsimd/xsimd.hpp>

#include GRAINSWEEP_ARCH_HEADER

namespace {

using grainsweep::block_width;

template <class Real>
using Batch = xsimd::batch<Real, Arch>;

/// Lanes of one hardware batch, and batches to a block.
template <class Real>
inline constexpr std::size_t batch_width = Batch<Real>::size;
template <class Real>
inline constexpr std::size_t batches = block_width / batch_width<Real>;

template <class Real>
inline Batch<Real> load(const Real* from) {
  return Batch<Real>::load_unaligned(from);
}

/// One vector per lane.
template <class Real>
struct Vectors {
  Batch<Real> x, y, z;
};
template <class Real>
inline Batch<Real> dot(const Vectors<Real>& u, const Vectors<Real>& v) {
  return u.x * v.x + u.y * v.y + u.z * v.z;
}

/// Nearest image of a difference of coordinates along an axis of a period, whose inverse is given;
/// unchanged if both are 0.
inline Batch<double> nearest_image(const Batch<double>& difference, double period, double inverse) {
  return difference - Batch<double>(period) * xsimd::nearbyint(difference * Batch<double>(inverse));
}
inline double inverse_of(double period) { return period > 0 ? 1 / period : 0; }

/// Stores a batch of f64 as Real.
template <class Real>
inline void store_rounded(const Batch<double>& from, Real* to) {
  double lane[batch_width<double>];
  from.store_unaligned(lane);
  for (std::size_t k = 0; k < batch_width<double>; ++k) to[k] = static_cast<Real>(lane[k]);
}

/// The residual of min(p, w) = 0: by how much impulses p and scaled gaps w fail to be
/// complementary.
template <class Real>
inline Batch<Real> natural_residual(const Batch<Real>& p, const Batch<Real>& w) {
  return xsimd::abs(xsimd::min(p, w));
}

/// One value per lane of a block, reduced over lanes in a fixed order.
template <class Real>
struct LaneSums {
  Batch<Real> part[batches<Real>];

  explicit LaneSums(Real value) {
    for (Batch<Real>& batch : part) {
      batch = Batch<Real>(value);
    }
  }

  /// Pairwise: lane k joins lane k + 8, then k + 4, k + 2, k + 1.
  template <class Join>
  Real reduce(Join join) const {
    Real lane[block_width];
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      part[k].store_unaligned(lane + k * batch_width<Real>);
    }
    for (std::size_t half = block_width / 2; half > 0; half /= 2) {
      for (std::size_t k = 0; k < half; ++k) {
        lane[k] = join(lane[k], lane[k + half]);
      }
    }
    return lane[0];
  }
  Real sum() const {
    return reduce([](Real a, Real b) { return a + b; });
  }
  Real max() const {
    return reduce([](Real a, Real b) { return a < b ? b : a; });
  }
};

/// Residuals of rows, lane by lane.
template <class Real>
struct LaneMissed {
  LaneSums<Real> largest{Real(0)}, squares{Real(0)}, loaded{Real(0)};

  /// Rows of the hardware batch k with these residuals and impulses, of grains with these inverse
  /// masses.
  void add(std::size_t k, const Batch<Real>& residual, const Batch<Real>& p,
           const Batch<Real>& inverse_a, const Batch<Real>& inverse_b) {
    const Batch<Real> zero(Real(0)), one(Real(1));
    const Batch<Real> missed = residual * xsimd::max(one, xsimd::max(inverse_a, inverse_b));
    largest.part[k] = xsimd::max(largest.part[k], missed);
    squares.part[k] += missed * missed;
    loaded.part[k] += xsimd::select(p > zero, one, zero);
  }
  grainsweep::Missed<Real> sums() const { return {largest.max(), squares.sum(), loaded.sum()}; }
};

}  // namespace
