// Oracle of solves with levers: the dual problem written out as a dense matrix in long double.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "engine/dynamics/solve.hpp"
#include "engine/rows/polyhedron_contacts.hpp"

namespace grainsweep::testing {

using Wide = long double;
using WideMatrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>;
using WideVector = Eigen::Matrix<Wide, Eigen::Dynamic, 1>;

/// A p + w >= 0, p >= 0, p . (A p + w) = 0; impulses in the order of the rows' columns.
struct DenseBodies {
  WideMatrix coupling;  ///< A
  WideVector gaps;      ///< w without impulses

  Wide violation(const WideVector& p) const {
    const WideVector w = coupling * p + gaps;
    Wide worst = 0;
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      if (!(coupling(k, k) > 0)) continue;
      worst = std::max(worst, std::abs(std::min(p[k], w[k] / coupling(k, k))));
    }
    return worst;
  }
};

/// The problem that `solve` is given: a row of H^T for every lane of every point, void ones too.
template <class Real>
DenseBodies dense_bodies(const PolyhedronContacts<Real>& rows,
                         const std::vector<Record<Real>>& free) {
  const auto size = static_cast<Eigen::Index>(rows.impulse.size());
  const auto motions = static_cast<Eigen::Index>(4 * free.size());
  WideMatrix directions = WideMatrix::Zero(size, motions);
  DenseBodies problem;
  WideVector gap(size), u(motions), inverse(motions);
  for (const BodyBlock<Real>& block : rows.blocks) {
    for (std::uint32_t i = block.first; i < block.first + block.points; ++i) {
      for (std::size_t lane = 0; lane < block_width; ++lane) {
        const auto row = static_cast<Eigen::Index>(i * block_width + lane);
        const Eigen::Index a = 8 * block.a(lane), b = 8 * block.b(lane);
        const Real n[3] = {block.normal_x[lane], block.normal_y[lane], block.normal_z[lane]};
        for (Eigen::Index k = 0; k < 3; ++k) {
          directions(row, a + k) = -n[k];
          directions(row, b + k) = n[k];
          directions(row, a + 4 + k) = -rows.points[i].lever_a[k][lane];
          directions(row, b + 4 + k) = rows.points[i].lever_b[k][lane];
        }
        gap[row] = rows.points[i].gap[lane];
      }
    }
  }
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(4 * k);
    u.segment(at, 4) << free[k].x, free[k].y, free[k].z, 0;
    inverse.segment(at, 4).setConstant(free[k].w);
  }
  problem.coupling = directions * inverse.asDiagonal() * directions.transpose();
  problem.gaps = gap + directions * u;
  return problem;
}

/// Impulses to a violation below 1e-16, by projected Gauss-Seidel.
inline WideVector solve_dense(const DenseBodies& problem) {
  WideVector p = WideVector::Zero(problem.gaps.size());
  for (int sweep = 0; sweep < 200'000 && problem.violation(p) > 1e-16L; ++sweep) {
    for (Eigen::Index k = 0; k < p.size(); ++k) {
      const Wide w = problem.coupling.row(k).dot(p) + problem.gaps[k];
      if (problem.coupling(k, k) > 0) p[k] = std::max(Wide(0), p[k] - w / problem.coupling(k, k));
    }
  }
  return p;
}

}  // namespace grainsweep::testing
