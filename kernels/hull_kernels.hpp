// Corners and faces of a convex hull, many at a time; see engine/narrow/separating_axes.hpp.
//
// Columns hold one number of each item and must be readable up to a multiple of block_width. Beyond
// the items, points of `farthest` are 0, which lies within a hull, offsets of planes are infinite,
// and all others are any finite numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace grainsweep {

struct PointColumns {
  const double* x;  ///< d
  const double* y;
  const double* z;
  std::size_t count;
};

struct PlaneColumns {
  PointColumns normal;   ///< unit, outward
  const double* offset;  ///< d; the hull lies where normal . x <= offset
};

/// Edges, with the normals of the faces left and right of them.
struct EdgeColumns {
  PointColumns from;                ///< where they begin, d
  PointColumns along, left, right;  ///< unit vectors, as many of each
};
struct HullEdge {
  double from[3], along[3], left[3], right[3];
};

/// Whether the axis along the cross product of two edges' directions, or the opposite one, lies
/// between the normals of the faces at both edges.
enum Crossing : std::uint8_t { no_crossing = 0, along_product = 1, against_product = 2 };

struct HullKernels {
  /// The point of a hull that is farthest along n, the first of equals. `reach` is set to how far
  /// each point reaches, and needs as much room as the columns.
  std::size_t (*farthest)(const PointColumns& points, const double* n, double* reach);
  /// The largest of `count` numbers, the first of equals; numbers beyond them, up to a multiple of
  /// block_width, must not be larger.
  std::size_t (*largest)(const double* numbers, std::size_t count);
  /// Heights of x over planes whose offsets are multiplied by `scale`; `least` of each plane
  /// becomes the least height seen so far.
  void (*heights)(const PlaneColumns& planes, double scale, const double* x, double* heights,
                  double* least);
  /// Sets bit k of below[f] where heights[k stride + f] <= limit, for the first 64 of k < rows.
  void (*below)(const double* heights, std::size_t stride, std::size_t rows, double limit,
                std::uint64_t* below);
  /// How another edge crosses each, and, for those that cross, by how much it is beyond that along
  /// the unit vector of the product of their directions, d; 0 where they are parallel. Cosines
  /// above -`in_doubt` count as positive, those below `in_doubt` as negative, edges of a smaller
  /// sine than `parallel` as parallel.
  void (*crossings)(const EdgeColumns& edges, const HullEdge& other, double in_doubt,
                    double parallel, double* parted, std::uint8_t* crossings);
};

}  // namespace grainsweep
