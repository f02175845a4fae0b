// The search grid: spheres sorted into cells, with a border of shifted copies on periodic axes.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/broad/balls.hpp"
#include "engine/context.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Cells of a grid, without the border: `origin_z` is the bottom of the lowest inner cells; along x
/// and y they begin at 0.
struct Cells {
  double origin_z = 0.0;                            ///< d
  double size_x = 0.0, size_y = 0.0, size_z = 0.0;  ///< d
  std::int32_t inner_x = 0, inner_y = 0, inner_z = 0;

  std::int32_t count() const { return (inner_x + 2) * (inner_y + 2) * (inner_z + 2); }
  /// Cell number of inner coordinates; -1 and `inner` address the border.
  std::int32_t at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return ((z + 1) * (inner_y + 2) + y + 1) * (inner_x + 2) + x + 1;
  }
  /// Inner coordinate along an axis; what lies outside belongs to the nearest cell.
  std::int32_t place_along(int axis, const Record<double>& sphere) const;
  std::int32_t inner(int axis) const { return axis == 0 ? inner_x : axis == 1 ? inner_y : inner_z; }
  /// Number of the inner cell that it lies in or is nearest to.
  std::int32_t cell_of(const Record<double>& sphere) const;
};

/// Cells over the box and the heights bottom .. top, no smaller than `least`, d. Their number grows
/// no faster than `grains`, which bounds the memory of sparse beds.
Cells make_cells(const Box& box, double bottom, double top, double least, std::size_t grains);

/// A grain in a cell: itself or, in a border cell, a copy shifted by periods.
struct GridImage {
  std::int32_t grain, cell;
  std::int32_t turns_x, turns_y;  ///< periods by which it is shifted: -1, 0 or 1
  std::int32_t entry;             ///< its place in the columns
};

/// Spheres by cell. Memory of a search, kept from one search to the next.
struct GridColumns {
  std::vector<float> x, y, z, radius;
  std::vector<std::int32_t> grain, cell_begin, next_entry;
  std::vector<std::vector<GridImage>> images;  ///< of each part of the grains
};

/// Sorts the grains `members` of a wrapped bed and their border copies into cells (a counting sort:
/// stable, linear).
void fill_columns(const Balls& balls, const std::vector<std::int32_t>& members, const Cells& cells,
                  const ParallelFor& loop, GridColumns& grid);

/// What kernels read of a grid.
SphereGrid view_of(const GridColumns& grid, const Cells& cells, float reach);

}  // namespace grainsweep
