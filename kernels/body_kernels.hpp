// Rows of contacts between polyhedra, and the sweeps of the solver over them.
//
// A grain has two records in a column of motion: its displacement v with its inverse mass, and
// sqrt(I) w with a 1: w is the angle vector of its turn in its own frame, I its principal moments.
// So an impulse p along the normal n changes them by
//   v += p n / m,  sqrt(I) w += p lever,  lever = (r x n in the grain's frame) / sqrt(I)
// and no moment of inertia is needed anywhere else. Walls have an inverse mass and levers of 0.
#pragma once

#include "kernels/row_kernels.hpp"

namespace grainsweep {

/// `block_width` contacts; all points of a contact share its normal. Unused lanes name void grains.
/// A row is a point k of a contact and says, to first order,
///   gap_k + n . (v_b - v_a) + lever_b,k . (sqrt(I) w)_b - lever_a,k . (sqrt(I) w)_a >= 0.
/// The normal is the unit vector from a to b, box frame.
template <class Real>
struct BodyBlock : BlockGrains<2 * sizeof(Record<Real>)> {
  Real normal_x[block_width] = {};
  Real normal_y[block_width] = {};
  Real normal_z[block_width] = {};
  std::uint32_t first = 0;   ///< its points are points[first] .. points[first + points - 1]
  std::uint32_t points = 0;  ///< as many as the contact with most has; others are filled up with
                             ///< void points
};

/// One point of each contact of a block. A void point has levers of 0 and a positive gap.
template <class Real>
struct alignas(64) BodyPoints {
  Real lever_a[3][block_width];    ///< x, y, z in the frame of a
  Real lever_b[3][block_width];    ///< in the frame of b
  Real gap[block_width];           ///< right-hand side, d; negative where grains overlap
  Real reduced_mass[block_width];  ///< 1 / A_kk, m: what an impulse on this row alone is divided by
};

/// Rows as sweeps read them.
template <class Real>
struct BodyRows {
  const BodyBlock<Real>* blocks;  ///< first of those to sweep
  const BodyPoints<Real>* points;
};

/// A sweep solves the points of a contact one after the other, in blocks with more of them than
/// this forth and back. Of the forces of a face on a face three are independent, whatever the
/// number of its corners: the more there are, the more one order of them differs from another, and
/// momentum makes sweeps in one order diverge. A sweep forth and back has a symmetric matrix, as a
/// gradient step has.
inline constexpr std::size_t most_points_swept_once = 3;

/// Solver sweeps for one number type. `u` and `accumulated` hold two records per grain. The impulse
/// of lane k of points[i] is p[i * block_width + k].
template <class Real>
struct BodyKernels {
  /// As RowKernels::gauss_seidel_sweep, with A_kk for 1/m_a + 1/m_b. For points swept forth and
  /// back the residuals are those on the way forth; the restart test adds up both ways.
  SweepSums<Real> (*gauss_seidel_sweep)(BodyRows<Real> rows, std::size_t blocks, Record<Real>* u,
                                        Real* p, Real* y, SweepRule<Real> rule);
  /// Adds H p to the accumulated impulses.
  void (*accumulate_impulses)(BodyRows<Real> rows, std::size_t blocks, const Real* p,
                              Record<Real>* accumulated);
  /// As RowKernels::residual, with A_kk for 1/m_a + 1/m_b.
  Missed<Real> (*residual)(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u,
                           const Real* p);
  /// Sets the gaps of the points of the rows, which are `moved`, to those after the motion u. Where
  /// grains overlap a gap holds the share `correction` of the overlap, before and after.
  void (*move_gaps)(BodyRows<Real> rows, std::size_t blocks, const Record<Real>* u, Real correction,
                    BodyPoints<Real>* moved);
};

}  // namespace grainsweep
