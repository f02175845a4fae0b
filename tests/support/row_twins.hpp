// Plain-loop twins of the row kernels: one row after the other, the same operations in the same
// order, nothing else. The kernels must agree with them to the last bit.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/kernels.hpp"

namespace grainsweep::testing {

/// Minimum and maximum as the processor has them: the second operand if neither is smaller.
template <class Real>
Real smaller(Real a, Real b) {
  return a < b ? a : b;
}
template <class Real>
Real larger(Real a, Real b) {
  return a > b ? a : b;
}

/// w / A of one row: the gap after the motion u times the reduced mass.
template <class Real>
Real scaled_gap_twin(const RowBlock<Real>& r, std::size_t lane, const Record<Real>* u) {
  const Record<Real>&a = u[r.a(lane)], &b = u[r.b(lane)];
  const Real approach = r.normal_x[lane] * (b.x - a.x) + r.normal_y[lane] * (b.y - a.y) +
                        r.normal_z[lane] * (b.z - a.z);
  return (r.gap[lane] + approach) * r.reduced_mass[lane];
}

/// Adds `share` of an impulse p along the normal.
template <class Real>
void add_twin(const RowBlock<Real>& r, std::size_t lane, Real p, Real share, Record<Real>& to) {
  to.x += share * (p * r.normal_x[lane]);
  to.y += share * (p * r.normal_y[lane]);
  to.z += share * (p * r.normal_z[lane]);
}

/// Impulse p of one row: pushes a by -p normal, b by +p normal.
template <class Real>
void push_twin(const RowBlock<Real>& r, std::size_t lane, Real p, Record<Real>* accumulated) {
  add_twin(r, lane, p, Real(-1), accumulated[r.a(lane)]);
  add_twin(r, lane, p, Real(1), accumulated[r.b(lane)]);
}

template <class Real>
void apply_impulses_twin(const Record<Real>* free, std::size_t count, Record<Real>* accumulated,
                         Record<Real>* u) {
  for (std::size_t i = 0; i < count; ++i) {
    u[i] = free[i];
    u[i].x += free[i].w * accumulated[i].x;
    u[i].y += free[i].w * accumulated[i].y;
    u[i].z += free[i].w * accumulated[i].z;
    accumulated[i] = {Real(0), Real(0), Real(0), Real(0)};
  }
}

/// Lane sums are joined pairwise: lane k with k + 8, then k + 4, k + 2, k + 1.
template <class Real>
Real tree_sum(Real (&lane)[block_width]) {
  for (std::size_t half = block_width / 2; half > 0; half /= 2) {
    for (std::size_t k = 0; k < half; ++k) {
      lane[k] += lane[k + half];
    }
  }
  return lane[0];
}

/// Sums of the residuals of rows, lane by lane.
template <class Real>
struct MissedTwin {
  Real largest = 0, squares[block_width] = {}, loaded[block_width] = {};

  /// A row of the lane with impulse p; `inverse` masses of its grains.
  void add(std::size_t lane, Real residual, Real p, Real inverse_a, Real inverse_b) {
    const Real missed = residual * larger(Real(1), larger(inverse_a, inverse_b));
    largest = larger(largest, missed);
    squares[lane] += missed * missed;
    loaded[lane] += p > 0 ? Real(1) : Real(0);
  }
  Missed<Real> sums() { return {largest, tree_sum(squares), tree_sum(loaded)}; }
};

/// If `from` is given, p and y are changes of the impulses in it; otherwise whole impulses.
template <class Real>
SweepSums<Real> gauss_seidel_twin(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                                  Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule) {
  MissedTwin<Real> missed;
  Real restart_test[block_width] = {};
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const std::size_t row = block * block_width + lane;
      const Real w = scaled_gap_twin(rows[block], lane, u), y_old = y[row], p_old = p[row];
      const Real before = from == nullptr ? Real(0) : from[row];
      const Real p_new = larger(Real(0) - before, y_old - w * rule.relaxation);
      const Real change = p_new - p_old;
      p[row] = p_new;
      y[row] = p_new + rule.momentum * change;
      restart_test[lane] += (y_old - p_new) * change;
      const RowBlock<Real>& r = rows[block];
      missed.add(lane, std::abs(smaller(before + y_old, w)), before + p_new, u[r.a(lane)].w,
                 u[r.b(lane)].w);
      add_twin(r, lane, p_new - y_old, Real(0) - u[r.a(lane)].w, u[r.a(lane)]);
      add_twin(r, lane, p_new - y_old, u[r.b(lane)].w, u[r.b(lane)]);
    }
  }
  return {missed.sums(), tree_sum(restart_test)};
}

template <class Real>
void extrapolate_twin(Real momentum, std::size_t count, Record<Real>* before, Record<Real>* u) {
  const auto extrapolated = [&](Real now, Real then) { return now + momentum * (now - then); };
  for (std::size_t i = 0; i < count; ++i) {
    const Record<Real> now = u[i], then = before[i];
    u[i] = {extrapolated(now.x, then.x), extrapolated(now.y, then.y), extrapolated(now.z, then.z),
            extrapolated(now.w, then.w)};
    before[i] = now;
  }
}

template <class Real>
void accumulate_impulses_twin(const RowBlock<Real>* rows, std::size_t blocks, const Real* p,
                              Record<Real>* accumulated) {
  for (std::size_t row = 0; row < blocks * block_width; ++row) {
    push_twin(rows[row / block_width], row % block_width, p[row], accumulated);
  }
}

template <class Real>
Missed<Real> residual_twin(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                           const Record<Real>* u, const Real* p) {
  MissedTwin<Real> missed;
  for (std::size_t row = 0; row < blocks * block_width; ++row) {
    const Real w = scaled_gap_twin(rows[row / block_width], row % block_width, u);
    const RowBlock<Real>& r = rows[row / block_width];
    const auto a = static_cast<std::size_t>(r.a(row % block_width));
    const auto b = static_cast<std::size_t>(r.b(row % block_width));
    const Real whole = from == nullptr ? p[row] : from[row] + p[row];
    missed.add(row % block_width, std::abs(smaller(whole, w)), whole, u[a].w, u[b].w);
  }
  return missed.sums();
}

inline double nearest_image_twin(double difference, double period) {
  const double inverse = period > 0 ? 1 / period : 0;
  return difference - period * std::nearbyint(difference * inverse);
}

template <class Real>
double sphere_gaps_twin(RowBlock<Real>* rows, std::size_t blocks, const Record<double>* positions,
                        double period_x, double period_y, double correction) {
  double sunk = -1e300;
  for (std::size_t row = 0; row < blocks * block_width; ++row) {
    RowBlock<Real>& r = rows[row / block_width];
    const std::size_t lane = row % block_width;
    const Record<double>&a = positions[r.a(lane)], &b = positions[r.b(lane)];
    const double x = nearest_image_twin(b.x - a.x, period_x);
    const double y = nearest_image_twin(b.y - a.y, period_y);
    const double z = b.z - a.z;
    const double distance = std::sqrt(x * x + y * y + z * z);
    const double touching = a.w + b.w, gap = distance - touching;
    sunk = larger(sunk, sunk_share * touching - distance);
    const double length = distance > 0 ? distance : 1;
    r.normal_x[lane] = static_cast<Real>(x / length);
    r.normal_y[lane] = static_cast<Real>(y / length);
    r.normal_z[lane] = static_cast<Real>((distance > 0 ? z : 1) / length);
    r.gap[lane] = static_cast<Real>(larger(gap, 0.0) + correction * smaller(gap, 0.0));
  }
  return sunk;
}

}  // namespace grainsweep::testing
