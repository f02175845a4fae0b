// One step's impulses: a convex problem with one unknown per row.
//
//   minimise 1/2 |u - u_free|^2_M  subject to  gap_c + n_c . (u_b - u_a) >= 0
//
// Its dual is A p + w_free >= 0, p >= 0, p . (A p + w_free) = 0 with A = H^T M^-1 H. The residual
// of a row is |min(p, w / A_kk)| / dt^2, in m g: the force by which it misses balance, in weights
// of the lighter grain where that is lighter than m. For spheres, A_kk = 1/m_a + 1/m_b; bodies add
// the squares of their levers (kernels/body_kernels.hpp). Masses here are inertias: in stages by
// depth they differ from what weighs (engine/dynamics/inertia.hpp).
#pragma once

#include <vector>

#include "engine/context.hpp"
#include "engine/rows/polyhedron_contacts.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "engine/scene/spec.hpp"
#include "engine/shape/convex_shape.hpp"
#include "engine/units.hpp"

namespace grainsweep {

struct SolveLimits {
  Solver solver = Solver::accelerated_gauss_seidel;
  int iterations = 100;        ///< most sweeps, unless they leave more than `residual_cap`
  double tolerance = 1e-3;     ///< residual at which to stop, as a mass times d (m g dt^2)
  double rms_tolerance = 0.0;  ///< or its root mean square over the rows that push, a mass times d
  /// While the residual is larger, a mass times d, iterations are doubled, until they reach
  /// `iteration_cap` or doubling has twice failed to bring it down: where rounding limits it, more
  /// do not help.
  double residual_cap = infinity;
  int iteration_cap = 0;
};

struct SolveReport {
  int iterations = 0;     ///< sweeps done
  double residual = 0.0;  ///< true residual of the impulses left behind, a mass times d
  double rms = 0.0;       ///< its root mean square over the rows that push, a mass times d
  double loaded = 0.0;    ///< number of these rows
};

/// Motion columns of a solve, indexed like the bed: displacement, d, and inverse mass. Grains that
/// turn have a second record each.
template <class Real>
struct MotionColumns {
  std::vector<Record<Real>> free;         ///< in: motion without contacts
  std::size_t first_moving = 0;           ///< in: nothing moves the records before it
  std::vector<Record<Real>> u;            ///< out: motion with the impulses of `contacts`
  std::vector<Record<Real>> accumulated;  ///< impulses on each grain, summed; +0 between sweeps
  std::vector<Record<Real>> before;       ///< motion after the last sweep
  std::vector<Record<Real>> summed;       ///< the same without the rounding of the sweeps
  std::vector<SweepSums<Real>> seen;      ///< by each part of the last phase
  std::vector<Vector> changed_from;       ///< memory of solve_changes: what `u` is a change of, d
  std::vector<Record<Real>> whole_free;   ///< memory of the same
};

/// Improves `contacts.impulse`, starting from what it holds, until the residual is below the
/// tolerance or the iterations are used up. Works for contacts of any kind.
template <class Rows, class Real>
SolveReport solve(const SolveLimits& limits, const ExecutionContext& context, Rows& contacts,
                  MotionColumns<Real>& motion);

}  // namespace grainsweep
