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

#include "kernels/body_kernels.hpp"
#include "kernels/front_kernels.hpp"
#include "kernels/hull_kernels.hpp"
#include "kernels/isa.hpp"
#include "kernels/row_kernels.hpp"

namespace grainsweep {

/// Spheres sorted by the cells of a uniform grid. Along each axis cells are no narrower than the
/// largest diameter and `reach` together, or there is only one: only adjacent cells are searched.
/// The grid has one layer of border cells on every side; on periodic axes these hold shifted
/// copies, so that no search ever wraps. Columns must be readable `block_width` entries past the
/// last sphere.
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
  const float* radius;  ///< d; with the grid's largest one and its reach no wider than a cell
  const std::int32_t* grain;
  const std::int32_t* cell;  ///< the inner cell of the grid that a sphere lies in or is nearest to
  std::size_t count;
};

/// Two grains that may touch, a < b.
struct GrainPair {
  std::int32_t a, b;
};

/// Half length, width, ridge and height of a pinacoid, d: along a unit vector n in its frame it
/// reaches max(a |nx| + b |ny|, c |nx| + e |nz|) from its centre, times the size in its record.
struct PinacoidHalves {
  double a = 0.0, b = 0.0, c = 0.0, e = 0.0;
  bool operator==(const PinacoidHalves&) const = default;
};

/// Edges count as parallel in f32 if the squared sine of their angle is smaller than this.
inline constexpr float parallel_edges_sine2 = 2.5e-3F;

/// Separations of the f32 test are accurate to this, d, per unit of scale of the larger grain if
/// neither reaches further than 1 d from its centre, else per unit of the larger reach: centres
/// closer than 4 d lose some 20 roundings of 6e-8, which the least sine of edges divides by 0.05.
inline constexpr float pinacoid_rounding = 2e-5F;

/// `block_width` pairs of pinacoids, all grains a of one shape and all grains b of one shape: which
/// pairs they are, and what parts them.
/// An axis has the number 0 .. 3 for face normal k of grain a, 4 .. 7 for face normal k - 4 of
/// grain b, 8 + 6 i + j for the cross product of edge direction i of a and j of b. Unused lanes
/// name grain 0 twice.
struct PinacoidBlock : BlockGrains<sizeof(Record<double>)> {
  float face_separation[block_width];  ///< largest over the face axes, d; negative = overlap
  float edge_separation[block_width];  ///< largest over the edge axes, d
  std::int32_t face_axis[block_width];
  std::int32_t edge_axis[block_width];
  /// 1 if some edges of the two are parallel within parallel_edges_sine2: their axes, which f32
  /// cannot resolve, were left out, and a pair that is not apart has to be tested in f64.
  std::int32_t edges_parallel[block_width];
};

/// The kernels that exist for each number type.
template <class Real>
struct NumberKernels {
  const RowKernels<Real>& rows;
  const BodyKernels<Real>& bodies;
  const FrontKernels<Real>& fronts;
};

struct Kernels {
  Isa isa;
  NumberKernels<float> f32;
  NumberKernels<double> f64;
  const HullKernels& hull;
  /// All pairs of the grid with gap below `reach`, each once, in the order of the grid. Writes at
  /// most `capacity` of them and returns how many there are.
  std::size_t (*sphere_pairs)(const SphereGrid& grid, GrainPair* pairs, std::size_t capacity);
  /// All pairs of a query and a sphere of the grid with gap below the grid's reach, in the order of
  /// the queries and of the grid. Writes at most `capacity` and returns how many there are.
  std::size_t (*sphere_pairs_across)(const SphereGrid& grid, const SphereQueries& queries,
                                     GrainPair* pairs, std::size_t capacity);
  /// Best axes of pairs of pinacoids by the separating-axis test, f32; see `PinacoidBlock`.
  /// `centres`: x, y, z and size; `orientations`: x, y, z, w of the unit quaternion from the
  /// shape's frame to the box's. period_x, period_y: d, 0 where the axis is walled. A pair whose
  /// larger separation exceeds a margin by pinacoid_rounding is further apart than that margin.
  void (*pinacoid_axes)(const PinacoidHalves& shape_a, const PinacoidHalves& shape_b,
                        PinacoidBlock* pairs, std::size_t blocks, const Record<double>* centres,
                        const Record<double>* orientations, double period_x, double period_y);
};

/// The kernels compiled for `isa`. Requires is_supported(isa).
const Kernels& kernels_for(Isa isa);

/// The kernels of `kernels` for a number type.
template <class Real>
const NumberKernels<Real>& kernels_of(const Kernels& kernels) {
  if constexpr (sizeof(Real) == sizeof(float)) {
    return kernels.f32;
  } else {
    return kernels.f64;
  }
}

}  // namespace grainsweep
