// Solver sweeps over rows of frictionless sphere contacts, and the narrow phase that fills the
// rows.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::Record;
using grainsweep::RowBlock;
using grainsweep::SweepSums;

/// One hardware batch of rows with the motion of both grains.
template <class Real>
struct Rows {
  const std::int32_t* a;
  const std::int32_t* b;
  Components<Real> u_a, u_b;
  Batch<Real> nx, ny, nz, gap;
};

template <class Real>
inline Rows<Real> load_rows(const RowBlock<Real>& block, std::size_t lane, const Record<Real>* u) {
  const std::int32_t* a = block.a + lane;
  const std::int32_t* b = block.b + lane;
  return {a,
          b,
          load_records(u, a),
          load_records(u, b),
          load(block.normal_x + lane),
          load(block.normal_y + lane),
          load(block.normal_z + lane),
          load(block.gap + lane)};
}

/// w / A: the gap after the motion u over 1/m_a + 1/m_b.
template <class Real>
inline Batch<Real> scaled_gap(const Rows<Real>& r) {
  const Batch<Real> approach =
      r.nx * (r.u_b.x - r.u_a.x) + r.ny * (r.u_b.y - r.u_a.y) + r.nz * (r.u_b.z - r.u_a.z);
  return (r.gap + approach) / (r.u_a.w + r.u_b.w);
}

template <class Real>
inline Batch<Real> natural_residual(const Batch<Real>& p, const Batch<Real>& w) {
  return xsimd::abs(xsimd::min(p, w));
}

/// Motion that impulses p give to a grain of inverse mass m: the sign is that of p.
template <class Real>
inline Components<Real> motion_of(const Rows<Real>& r, const Batch<Real>& p,
                                  const Batch<Real>& inverse_mass) {
  const Batch<Real> push = p * inverse_mass;
  return {push * r.nx, push * r.ny, push * r.nz, Batch<Real>(Real(0))};
}

/// 0 - p, not -p: whether negation turns 0 into -0 depends on the instruction set.
template <class Real>
inline void add_impulses(const Rows<Real>& r, const Batch<Real>& p, Record<Real>* u) {
  add_to_records(u, r.a, motion_of(r, Batch<Real>(Real(0)) - p, r.u_a.w));
  add_to_records(u, r.b, motion_of(r, p, r.u_b.w));
}

template <class Real>
SweepSums<Real> gradient_sweep(const RowBlock<Real>* rows, std::size_t blocks,
                               const Record<Real>* u, Record<Real>* next, Real* p, Real* y,
                               Real inverse_bound, Real momentum) {
  LaneSums<Real> residual(Real(0)), uphill(Real(0));
  const Batch<Real> zero(Real(0)), bound(inverse_bound), carry(momentum);
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const Rows<Real> r = load_rows(rows[block], lane, u);
      const Batch<Real> w = scaled_gap(r), y_old = load(y + at), p_old = load(p + at);
      const Batch<Real> p_new = xsimd::max(zero, y_old - w * bound);
      const Batch<Real> change = p_new - p_old;
      const Batch<Real> y_new = p_new + carry * change;
      residual.part[k] = xsimd::max(residual.part[k], natural_residual(y_old, w));
      uphill.part[k] += (y_old - p_new) * change;
      p_new.store_unaligned(p + at);
      y_new.store_unaligned(y + at);
      add_impulses(r, y_new, next);
    }
  }
  return {residual.max(), uphill.sum()};
}

template <class Real>
inline Components<Real> moved(const Components<Real>& u, const Components<Real>& by) {
  return {u.x + by.x, u.y + by.y, u.z + by.z, u.w};
}

template <class Real>
SweepSums<Real> gauss_seidel_sweep(const RowBlock<Real>* rows, std::size_t blocks, Record<Real>* u,
                                   Real* p, bool backward) {
  LaneSums<Real> residual(Real(0));
  const Batch<Real> zero(Real(0));
  for (std::size_t step = 0; step < blocks; ++step) {
    const std::size_t block = backward ? blocks - 1 - step : step;
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const std::size_t at = block * block_width + lane;
      const Rows<Real> r = load_rows(rows[block], lane, u);
      const Batch<Real> w = scaled_gap(r), p_old = load(p + at);
      const Batch<Real> p_new = xsimd::max(zero, p_old - w);
      const Batch<Real> change = p_new - p_old;
      residual.part[k] = xsimd::max(residual.part[k], natural_residual(p_old, w));
      p_new.store_unaligned(p + at);
      store_records(u, r.a, moved(r.u_a, motion_of(r, p_old - p_new, r.u_a.w)));
      store_records(u, r.b, moved(r.u_b, motion_of(r, change, r.u_b.w)));
    }
  }
  return {residual.max(), Real(0)};
}

template <class Real>
void apply_impulses(const RowBlock<Real>* rows, std::size_t blocks, const Real* p,
                    Record<Real>* u) {
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const Rows<Real> r = load_rows(rows[block], lane, u);
      add_impulses(r, load(p + block * block_width + lane), u);
    }
  }
}

template <class Real>
Real residual(const RowBlock<Real>* rows, std::size_t blocks, const Record<Real>* u,
              const Real* p) {
  LaneSums<Real> worst(Real(0));
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t k = 0; k < batches<Real>; ++k) {
      const std::size_t lane = k * batch_width<Real>;
      const Rows<Real> r = load_rows(rows[block], lane, u);
      const Batch<Real> impulse = load(p + block * block_width + lane);
      worst.part[k] = xsimd::max(worst.part[k], natural_residual(impulse, scaled_gap(r)));
    }
  }
  return worst.max();
}

/// Difference of two coordinates to the nearest image; `inverse_period` is 0 on a walled axis.
inline Batch<double> nearest_image(const Batch<double>& difference, double period,
                                   double inverse_period) {
  return difference -
         Batch<double>(period) * xsimd::nearbyint(difference * Batch<double>(inverse_period));
}

template <class Real>
void store_rounded(const Batch<double>& from, Real* to) {
  double lane[batch_width<double>];
  from.store_unaligned(lane);
  for (std::size_t k = 0; k < batch_width<double>; ++k) {
    to[k] = static_cast<Real>(lane[k]);
  }
}

template <class Real>
void sphere_gaps(RowBlock<Real>* rows, std::size_t blocks, const Record<double>* positions,
                 double period_x, double period_y, double correction) {
  const double inverse_x = period_x > 0 ? 1 / period_x : 0;
  const double inverse_y = period_y > 0 ? 1 / period_y : 0;
  const Batch<double> repair(correction), zero(0.0), one(1.0);
  for (std::size_t block = 0; block < blocks; ++block) {
    RowBlock<Real>& r = rows[block];
    for (std::size_t k = 0; k < batches<double>; ++k) {
      const std::size_t lane = k * batch_width<double>;
      const Components<double> a = load_records(positions, r.a + lane);
      const Components<double> b = load_records(positions, r.b + lane);
      const Batch<double> x = nearest_image(b.x - a.x, period_x, inverse_x);
      const Batch<double> y = nearest_image(b.y - a.y, period_y, inverse_y);
      const Batch<double> z = b.z - a.z;
      const Batch<double> distance = xsimd::sqrt(x * x + y * y + z * z);
      const Batch<double> gap = distance - (a.w + b.w);
      const auto apart = distance > zero;  // coinciding centres part upwards
      const Batch<double> length = xsimd::select(apart, distance, one);
      store_rounded(x / length, r.normal_x + lane);
      store_rounded(y / length, r.normal_y + lane);
      store_rounded(xsimd::select(apart, z, one) / length, r.normal_z + lane);
      store_rounded(xsimd::max(gap, zero) + repair * xsimd::min(gap, zero), r.gap + lane);
    }
  }
}

template <class Real>
constexpr grainsweep::RowKernels<Real> table() {
  return {gradient_sweep<Real>, gauss_seidel_sweep<Real>, apply_impulses<Real>, residual<Real>,
          sphere_gaps<Real>};
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {
extern const RowKernels<float> row_kernels_f32 = table<float>();
extern const RowKernels<double> row_kernels_f64 = table<double>();
}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
