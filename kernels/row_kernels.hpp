// Rows of sphere contacts and the sweeps of the solver over them. Masses are what resists motion,
// which is not always what weighs (engine/dynamics/inertia.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace grainsweep {

/// Lanes of a block: contacts that one kernel iteration handles together.
inline constexpr std::size_t block_width = 16;

/// Four numbers of one grain, loaded whole.
/// Positions: x, y, z and radius, d. Motion: displacement x, y, z, d, and inverse mass, 1/m.
template <class Real>
struct alignas(4 * sizeof(Real)) Record {
  Real x, y, z, w;
};

/// The two grains of each lane of a block, whose records in a column begin `grain_bytes` apart.
template <std::uint32_t grain_bytes>
struct alignas(64) BlockGrains {
  std::uint32_t offset_a[block_width];  ///< bytes from a column of records to grain a's first
  std::uint32_t offset_b[block_width];

  std::int32_t a(std::size_t lane) const { return grain_at(offset_a[lane]); }
  std::int32_t b(std::size_t lane) const { return grain_at(offset_b[lane]); }
  void set_grains(std::size_t lane, std::int32_t a, std::int32_t b) {
    offset_a[lane] = static_cast<std::uint32_t>(a) * grain_bytes;
    offset_b[lane] = static_cast<std::uint32_t>(b) * grain_bytes;
  }

 private:
  static std::int32_t grain_at(std::uint32_t offset) {
    return static_cast<std::int32_t>(offset / grain_bytes);
  }
};

/// Rows of `block_width` contacts. A row says gap + normal . (u_b - u_a) >= 0, where u are the
/// displacements of the step: the two grains may close the gap, not more.
/// The normal is the unit vector from a to b; an impulse p pushes b by +p normal, a by -p normal.
/// Unused lanes name void grains and have a positive gap.
template <class Real>
struct RowBlock : BlockGrains<sizeof(Record<Real>)> {
  Real normal_x[block_width];
  Real normal_y[block_width];
  Real normal_z[block_width];
  Real gap[block_width];           ///< right-hand side, d; negative where grains overlap
  Real reduced_mass[block_width];  ///< 1 / (1/m_a + 1/m_b), m
};

// A round wall keeps a grain's centre within a circle about its axis: a row's normal would turn
// while the grain moves along the wall, and a normal that stays behind pushes it along the wall. So
// a contact with a round wall is a pair of rows, in the same lane of two blocks that follow one
// another: their normals are -x and -y, so that their impulses are the two components, of any sign,
// of the impulse on the grain, and they are solved together: with c the centre from the axis and R
// the circle's radius
//
//   |c + u| <= R, and the impulse is along -(c + u) and not 0 only where |c + u| = R
//
// In such a pair the first block holds c_x as its gap and the grain's mass as its reduced mass; the
// second one c_y, and |c|^2 - R^2, which loses no digits to rounding, as its reduced mass.

/// By how much rows miss min(p, w / A) = 0, where A is 1/m_a + 1/m_b, d m; for a row with a grain
/// lighter than 1, in masses of that grain.
template <class Real>
struct Missed {
  Real largest = 0;  ///< d m
  Real squares = 0;  ///< sum over all rows, (d m)^2
  Real loaded = 0;   ///< number of rows that push
};

/// What one sweep over rows saw.
template <class Real>
struct SweepSums {
  Missed<Real> missed;  ///< before the update
  /// Sum of (y - p_new)(p_new - p_old) over rows: positive asks for a restart.
  Real restart_test = 0;
};

/// Grains have sunk into each other when their centres are nearer than this share of the distance
/// at which they touch: they may get past each other.
inline constexpr double sunk_share = 0.5;

/// How a Gauss-Seidel sweep goes.
template <class Real>
struct SweepRule {
  Real relaxation = 1;  ///< share of a row's own correction that is taken, 0..1
  Real momentum = 0;    ///< share of an impulse's change that is extrapolated
};

/// Solver sweeps for one number type. `u` are motion records indexed by RowBlock::a and b.
template <class Real>
struct RowKernels {
  /// u = free + M^-1 accumulated for `count` records, whose accumulated impulses are +0 then. The
  /// inverse masses are those of `free`.
  void (*apply_impulses)(const Record<Real>* free, std::size_t count, Record<Real>* accumulated,
                         Record<Real>* u);
  /// One projected Gauss-Seidel sweep, block after block; lanes of a block must not share a grain.
  /// Reads the extrapolated impulses y and their motion u = u(y); a row writes
  /// p = max(0, y - relaxation w / A), moves its grains by p - y at once, and then writes
  /// y = p + momentum (p - p_old). Leaves u = u(p). Without momentum y and p may be the same
  /// column. Unless `from` is null, impulses p and y are changes of those in it, and u and the gaps
  /// count from the motion of these: small changes are then not rounded with large impulses.
  SweepSums<Real> (*gauss_seidel_sweep)(const RowBlock<Real>* rows, std::size_t blocks,
                                        const Real* from, Record<Real>* u, Real* p, Real* y,
                                        SweepRule<Real> rule);
  /// The same for pairs of rows of round walls: a row's maximum becomes the nearest point of the
  /// circle. `blocks` counts both blocks of a pair.
  SweepSums<Real> (*round_sweep)(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                                 Record<Real>* u, Real* p, Real* y, SweepRule<Real> rule);
  /// The motion of extrapolated impulses: u = u + momentum (u - before) for `count` records; leaves
  /// what u was in `before`.
  void (*extrapolate)(Real momentum, std::size_t count, Record<Real>* before, Record<Real>* u);
  /// The same for `count` grains of `records` records each, those of grain g begin at record g *
  /// records.
  void (*extrapolate_grains)(Real momentum, const std::int32_t* grains, std::size_t count,
                             std::size_t records, Record<Real>* before, Record<Real>* u);
  /// Adds H p, the impulses of the rows, to the accumulated impulses of their grains.
  void (*accumulate_impulses)(const RowBlock<Real>* rows, std::size_t blocks, const Real* p,
                              Record<Real>* accumulated);
  /// Residuals of all rows, `from` as in a sweep; for round walls |p - the impulse that the row
  /// would give|.
  Missed<Real> (*residual)(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                           const Record<Real>* u, const Real* p);
  Missed<Real> (*round_residual)(const RowBlock<Real>* rows, std::size_t blocks, const Real* from,
                                 const Record<Real>* u, const Real* p);
  /// Normals and gaps of sphere pairs (a, b of `rows`) from their positions, nearest image.
  /// period_x, period_y: d, 0 where the axis is walled. A negative gap is multiplied by
  /// `correction`, the share of an overlap that one step repairs. Where centres coincide the normal
  /// is +z. Returns the most by which centres are nearer than sunk_share of the distance at which
  /// their grains touch, d; negative if none are.
  double (*sphere_gaps)(RowBlock<Real>* rows, std::size_t blocks, const Record<double>* positions,
                        double period_x, double period_y, double correction);
};

}  // namespace grainsweep
