// The number kernels: what they compute, and the table through which they are called.
//
// One source per kernel, compiled once for each instruction set; `kernels_for` picks a table at run
// time. Every kernel works on blocks of `block_width` lanes whatever the hardware's width is, with
// one rounding per operation and one order of reduction, so that all tables give the same bits.
//
// Kernels allocate nothing and check nothing: the caller keeps the promises stated here.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/isa.hpp"

namespace grainsweep {

/// Lanes of a block: contacts that one kernel iteration handles together.
inline constexpr std::size_t block_width = 16;

/// Four numbers of one grain, loaded whole.
/// Positions: x, y, z and radius, d. Motion: displacement x, y, z, d, and inverse mass, 1/m.
template <class Real>
struct alignas(4 * sizeof(Real)) Record {
  Real x, y, z, w;
};

/// Rows of `block_width` contacts. A row says gap + normal . (u_b - u_a) >= 0, where u are the
/// displacements of the step: the two grains may close the gap, not more.
/// The normal is the unit vector from a to b; an impulse p pushes b by +p normal, a by -p normal.
/// Unused lanes name void grains and have a positive gap.
template <class Real>
struct alignas(64) RowBlock {
  std::uint32_t offset_a[block_width];  ///< bytes from a column of Record<Real> to grain a's
  std::uint32_t offset_b[block_width];
  Real normal_x[block_width];
  Real normal_y[block_width];
  Real normal_z[block_width];
  Real gap[block_width];           ///< right-hand side, d; negative where grains overlap
  Real reduced_mass[block_width];  ///< 1 / (1/m_a + 1/m_b), m

  std::int32_t a(std::size_t lane) const { return grain_at(offset_a[lane]); }
  std::int32_t b(std::size_t lane) const { return grain_at(offset_b[lane]); }
  void set_grains(std::size_t lane, std::int32_t a, std::int32_t b) {
    offset_a[lane] = static_cast<std::uint32_t>(a) * record_bytes;
    offset_b[lane] = static_cast<std::uint32_t>(b) * record_bytes;
  }

 private:
  static constexpr std::uint32_t record_bytes = sizeof(Record<Real>);
  static std::int32_t grain_at(std::uint32_t offset) {
    return static_cast<std::int32_t>(offset / record_bytes);
  }
};

/// What one sweep over rows saw.
template <class Real>
struct SweepSums {
  Real residual;  ///< largest |min(p, w / (1/m_a + 1/m_b))| before the update, d m
  Real uphill;    ///< sum of (y - p_new)(p_new - p_old) over rows: positive asks for a restart
};

/// Solver sweeps for one number type. `u` are motion records indexed by RowBlock::a and b.
template <class Real>
struct RowKernels {
  /// One accelerated projected gradient iteration, fused: reads the extrapolated impulses y and
  /// motion u = u(y); writes p = max(0, y - w / (bound A)), then y = p + momentum (p - p_old), and
  /// adds H y to `pushes`: the sum of the impulses on each grain, which began as +0. Batches
  /// without impulses are skipped.
  SweepSums<Real> (*gradient_sweep)(const RowBlock<Real>* rows, std::size_t blocks,
                                    const Record<Real>* u, Record<Real>* pushes, Real* p, Real* y,
                                    Real inverse_bound, Real momentum);
  /// u = free + M^-1 pushes for `count` records; leaves the pushes empty, ready for a sweep. The
  /// inverse masses are those of `free`.
  void (*take_pushes)(const Record<Real>* free, std::size_t count, Record<Real>* pushes,
                      Record<Real>* u);
  /// One projected Gauss-Seidel sweep, block after block (the last block first if `backward`);
  /// lanes of a block must not share a grain. Updates p and u in place.
  SweepSums<Real> (*gauss_seidel_sweep)(const RowBlock<Real>* rows, std::size_t blocks,
                                        Record<Real>* u, Real* p, bool backward);
  /// Adds H p to the pushes.
  void (*add_pushes)(const RowBlock<Real>* rows, std::size_t blocks, const Real* p,
                     Record<Real>* pushes);
  /// Largest |min(p, w / (1/m_a + 1/m_b))| over all rows, d m.
  Real (*residual)(const RowBlock<Real>* rows, std::size_t blocks, const Record<Real>* u,
                   const Real* p);
  /// Normals and gaps of sphere pairs (a, b of `rows`) from their positions, nearest image.
  /// period_x, period_y: d, 0 where the axis is walled. A negative gap is multiplied by
  /// `correction`, the share of an overlap that one step repairs. Where centres coincide the normal
  /// is +z.
  void (*sphere_gaps)(RowBlock<Real>* rows, std::size_t blocks, const Record<double>* positions,
                      double period_x, double period_y, double correction);
};

/// Spheres sorted by the cells of a uniform grid. The grid has one layer of border cells on every
/// side; on periodic axes these hold shifted copies, so that no search ever wraps.
/// Columns must be readable `block_width` entries past the last sphere.
struct SphereGrid {
  const float* x;  ///< d, relative to the grid's origin
  const float* y;
  const float* z;
  const float* radius;                     ///< d
  const std::int32_t* grain;               ///< grain of each entry
  const std::int32_t* cell_begin;          ///< first entry of each cell; one more at the end
  std::int32_t cells_x, cells_y, cells_z;  ///< with the border; x runs fastest
  float reach;                             ///< pairs with gap below it are found, d
};

/// Spheres to look up in the grid of others. Positions are relative to that grid's origin.
struct SphereQueries {
  const float* x;  ///< d
  const float* y;
  const float* z;
  const float* radius;  ///< d; no larger than half a cell of the grid
  const std::int32_t* grain;
  const std::int32_t* cell;  ///< the inner cell of the grid that a sphere lies in or is nearest to
  std::size_t count;
};

/// Two grains that may touch, a < b.
struct GrainPair {
  std::int32_t a, b;
};

/// Half lengths of a pinacoid: along a unit vector n it reaches max(a |nx| + b |ny|,
/// c |nx| + e |nz|) from its centre, at scale 1.
struct PinacoidHalves {
  double a, b, c, e;  ///< d
};

/// Edges whose angle has a smaller square of its sine are parallel to f32.
inline constexpr float parallel_edges_sine2 = 2.5e-3F;

/// Separations of the f32 test are true to this, per unit of scale of the larger grain, d: centres
/// closer than 4 d lose some 20 roundings of 6e-8, which the least sine of edges divides by .05.
inline constexpr float pinacoid_rounding = 2e-5F;

/// `block_width` pairs of pinacoids of one shape: which, and what parts them.
/// An axis has the number 0 .. 3 for face normal k of grain a, 4 .. 7 for face normal k - 4 of
/// grain b, 8 + 6 i + j for the cross product of edge direction i of a and j of b. Unused lanes
/// name grain 0 twice.
struct alignas(64) PinacoidBlock {
  std::uint32_t offset_a[block_width];  ///< bytes from a column of Record<double> to grain a's
  std::uint32_t offset_b[block_width];
  float face_separation[block_width];  ///< largest over the face axes, d; negative = overlap
  float edge_separation[block_width];  ///< largest over the edge axes, d
  std::int32_t face_axis[block_width];
  std::int32_t edge_axis[block_width];
  /// 1 if some edges of the two are parallel within parallel_edges_sine2: their axes, which f32
  /// cannot tell, were left out, and a pair that is not apart has to be tested in f64.
  std::int32_t edges_parallel[block_width];

  void set_grains(std::size_t lane, std::int32_t a, std::int32_t b) {
    offset_a[lane] = static_cast<std::uint32_t>(a) * std::uint32_t{sizeof(Record<double>)};
    offset_b[lane] = static_cast<std::uint32_t>(b) * std::uint32_t{sizeof(Record<double>)};
  }
};

struct Kernels {
  Isa isa;
  RowKernels<float> f32;
  RowKernels<double> f64;
  /// All pairs of the grid with gap below `reach`, each once, in the order of the grid. Writes at
  /// most `capacity` of them and returns how many there are.
  std::size_t (*sphere_pairs)(const SphereGrid& grid, GrainPair* pairs, std::size_t capacity);
  /// All pairs of a query and a sphere of the grid with gap below the grid's reach, in the order of
  /// the queries and of the grid. Writes at most `capacity` and returns how many there are.
  std::size_t (*sphere_pairs_across)(const SphereGrid& grid, const SphereQueries& queries,
                                     GrainPair* pairs, std::size_t capacity);
  /// Best axes of pairs of pinacoids by the separating-axis test, f32; see `PinacoidBlock`.
  /// `centres`: x, y, z and scale; `orientations`: x, y, z, w of the unit quaternion from the
  /// shape's frame to the box's. period_x, period_y: d, 0 where the axis is walled. A pair
  /// whose larger separation exceeds a margin by pinacoid_rounding is further apart than the
  /// margin.
  void (*pinacoid_axes)(const PinacoidHalves& shape, PinacoidBlock* pairs, std::size_t blocks,
                        const Record<double>* centres, const Record<double>* orientations,
                        double period_x, double period_y);
};

/// The kernels compiled for `isa`. Requires is_supported(isa).
const Kernels& kernels_for(Isa isa);

/// Row kernels of `kernels` for a number type.
template <class Real>
const RowKernels<Real>& row_kernels(const Kernels& kernels);
template <>
inline const RowKernels<float>& row_kernels<float>(const Kernels& kernels) {
  return kernels.f32;
}
template <>
inline const RowKernels<double>& row_kernels<double>(const Kernels& kernels) {
  return kernels.f64;
}

}  // namespace grainsweep
