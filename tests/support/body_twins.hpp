// Plain-loop twins of the body kernels: one contact after the other, the same operations in the
// same order, nothing else. The kernels must agree with them to the last bit.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/kernels.hpp"
#include "tests/support/row_twins.hpp"

namespace grainsweep::testing {

/// Point i of the contact in one lane of a block.
template <class Real>
struct PointTwin {
  const BodyBlock<Real>& c;
  const BodyPoints<Real>& r;
  std::size_t lane;

  Real normal(const Record<Real>& v) const {
    return c.normal_x[lane] * v.x + c.normal_y[lane] * v.y + c.normal_z[lane] * v.z;
  }
  Real along(const Real (&lever)[3][block_width], const Record<Real>& turn) const {
    return lever[0][lane] * turn.x + lever[1][lane] * turn.y + lever[2][lane] * turn.z;
  }
  Real gap_after(const Record<Real>* u) const {
    const Record<Real>*a = u + 2 * c.a(lane), *b = u + 2 * c.b(lane);
    const Real approach = normal({b[0].x - a[0].x, b[0].y - a[0].y, b[0].z - a[0].z, 0});
    return r.gap[lane] + (approach + (along(r.lever_b, b[1]) - along(r.lever_a, a[1])));
  }
};

template <class Real>
PointTwin<Real> point_twin(BodyRows<Real> rows, std::size_t block, std::size_t lane,
                           std::size_t point) {
  return {rows.blocks[block], rows.points[rows.blocks[block].first + point], lane};
}

/// Calls visit(its block, number of the block, lane) for every contact.
template <class Real, class Visit>
void visit_lanes(BodyRows<Real> rows, std::size_t blocks, Visit visit) {
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) visit(rows.blocks[block], block, lane);
  }
}

template <class Real>
struct PushTwin {
  Real normal = 0, a[3] = {}, b[3] = {};

  void add(const PointTwin<Real>& t, Real p) {
    normal += p;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] += p * t.r.lever_a[k][t.lane];
      b[k] += p * t.r.lever_b[k][t.lane];
    }
  }
  void give(const BodyBlock<Real>& c, std::size_t lane, Record<Real>* accumulated) const {
    Record<Real>*from = accumulated + 2 * c.a(lane), *to = accumulated + 2 * c.b(lane);
    const Real n[3] = {normal * c.normal_x[lane], normal * c.normal_y[lane],
                       normal * c.normal_z[lane]};
    from[0] = {from[0].x - n[0], from[0].y - n[1], from[0].z - n[2], from[0].w};
    to[0] = {to[0].x + n[0], to[0].y + n[1], to[0].z + n[2], to[0].w};
    from[1] = {from[1].x - a[0], from[1].y - a[1], from[1].z - a[2], from[1].w};
    to[1] = {to[1].x + b[0], to[1].y + b[1], to[1].z + b[2], to[1].w};
  }
};

/// Adds an impulse p, of either sign, to the two records of one side.
template <class Real>
void push_side_twin(const BodyBlock<Real>& c, const Real (&lever)[3][block_width], std::size_t lane,
                    Real p, Record<Real>* side) {
  side[0].x += side[0].w * (p * c.normal_x[lane]);
  side[0].y += side[0].w * (p * c.normal_y[lane]);
  side[0].z += side[0].w * (p * c.normal_z[lane]);
  side[1].x += side[1].w * (p * lever[0][lane]);
  side[1].y += side[1].w * (p * lever[1][lane]);
  side[1].z += side[1].w * (p * lever[2][lane]);
}

template <class Real>
SweepSums<Real> body_gauss_seidel_twin(BodyRows<Real> rows, std::size_t blocks, Record<Real>* u,
                                       Real* p, Real* y, SweepRule<Real> rule) {
  MissedTwin<Real> missed;
  Real restart_test[block_width] = {};
  visit_lanes(rows, blocks, [&](const auto& c, std::size_t block, std::size_t lane) {
    const auto solve = [&](std::size_t i, bool is_first, bool is_last) {
      const PointTwin<Real> t = point_twin(rows, block, lane, i);
      const std::size_t at = (c.first + i) * block_width + lane;
      const Real w = t.gap_after(u) * t.r.reduced_mass[lane], y_old = y[at], p_old = p[at];
      const Real p_new = larger(Real(0), y_old - w * rule.relaxation), change = p_new - p_old;
      if (is_last) p[at] = p_new;
      y[at] = is_last ? p_new + rule.momentum * change : p_new;
      if (is_first) {
        missed.add(lane, std::abs(smaller(y_old, w)), p_new, u[2 * c.a(lane)].w,
                   u[2 * c.b(lane)].w);
      }
      restart_test[lane] += (y_old - p_new) * change;
      push_side_twin(c, t.r.lever_a, lane, Real(0) - (p_new - y_old), u + 2 * c.a(lane));
      push_side_twin(c, t.r.lever_b, lane, p_new - y_old, u + 2 * c.b(lane));
    };
    const bool goes_back = c.points > most_points_swept_once;
    for (std::size_t i = 0; i < c.points; ++i) solve(i, true, !goes_back);
    for (std::size_t i = c.points; goes_back && i-- > 0;) solve(i, false, true);
  });
  return {missed.sums(), tree_sum(restart_test)};
}

template <class Real>
void body_accumulate_impulses_twin(BodyRows<Real> rows, std::size_t blocks, const Real* p,
                                   Record<Real>* accumulated) {
  visit_lanes(rows, blocks, [&](const auto& c, std::size_t block, std::size_t lane) {
    PushTwin<Real> push;
    for (std::size_t i = 0; i < c.points; ++i) {
      push.add(point_twin(rows, block, lane, i), p[(c.first + i) * block_width + lane]);
    }
    push.give(c, lane, accumulated);
  });
}

template <class Real>
Missed<Real> body_residual_twin(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u,
                                const Real* p) {
  MissedTwin<Real> missed;
  visit_lanes(rows, blocks, [&](const auto& c, std::size_t block, std::size_t lane) {
    for (std::size_t i = 0; i < c.points; ++i) {
      const PointTwin<Real> t = point_twin(rows, block, lane, i);
      const Real w = t.gap_after(u) * t.r.reduced_mass[lane];
      const Real impulse = p[(c.first + i) * block_width + lane];
      missed.add(lane, std::abs(smaller(impulse, w)), impulse, u[2 * c.a(lane)].w,
                 u[2 * c.b(lane)].w);
    }
  });
  return missed.sums();
}

template <class Real>
void body_move_gaps_twin(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u,
                         Real correction, BodyPoints<Real>* moved) {
  visit_lanes(rows, blocks, [&](const auto& c, std::size_t block, std::size_t lane) {
    for (std::size_t i = 0; i < c.points; ++i) {
      Real& gap = moved[c.first + i].gap[lane];
      gap = gap < 0 ? gap / correction : gap;
      const Real after = point_twin(rows, block, lane, i).gap_after(u);
      gap = after < 0 ? correction * after : after;
    }
  });
}

}  // namespace grainsweep::testing
