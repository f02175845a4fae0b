// Plain-loop twin of the broad-phase kernel: the same tests in the same order, one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/kernels.hpp"

namespace grainsweep::testing {

inline bool is_close(const SphereGrid& grid, std::int32_t i, std::int32_t j) {
  const float dx = grid.x[j] - grid.x[i], dy = grid.y[j] - grid.y[i], dz = grid.z[j] - grid.z[i];
  const float limit = grid.radius[j] + (grid.radius[i] + grid.reach);
  return dx * dx + dy * dy + dz * dz < limit * limit;
}

inline void collect_close(const SphereGrid& grid, std::int32_t i, std::int32_t begin,
                          std::int32_t end, std::vector<GrainPair>& pairs) {
  for (std::int32_t j = begin; j < end; ++j) {
    if (is_close(grid, i, j)) {
      const std::int32_t a = grid.grain[i], b = grid.grain[j];
      pairs.push_back(a < b ? GrainPair{a, b} : GrainPair{b, a});
    }
  }
}

/// Each sphere against the rest of its cell and the next one, then against three cells of the next
/// row and of three rows of the next layer.
inline void collect_cell(const SphereGrid& grid, std::int32_t cell, std::vector<GrainPair>& pairs) {
  const std::int32_t row = grid.cells_x, layer = row * grid.cells_y;
  for (std::int32_t i = grid.cell_begin[cell]; i < grid.cell_begin[cell + 1]; ++i) {
    collect_close(grid, i, i + 1, grid.cell_begin[cell + 2], pairs);
    for (const std::int32_t ahead : {row, layer - row, layer, layer + row}) {
      collect_close(grid, i, grid.cell_begin[cell + ahead - 1], grid.cell_begin[cell + ahead + 2],
                    pairs);
    }
  }
}

inline std::vector<GrainPair> sphere_pairs_twin(const SphereGrid& grid) {
  std::vector<GrainPair> pairs;
  for (std::int32_t z = 1; z + 1 < grid.cells_z; ++z) {
    for (std::int32_t y = 1; y + 1 < grid.cells_y; ++y) {
      for (std::int32_t x = 1; x + 1 < grid.cells_x; ++x) {
        collect_cell(grid, (z * grid.cells_y + y) * grid.cells_x + x, pairs);
      }
    }
  }
  return pairs;
}

/// Each query against the 27 cells around its own, row after row.
inline std::vector<GrainPair> sphere_pairs_across_twin(const SphereGrid& grid,
                                                       const SphereQueries& queries) {
  std::vector<GrainPair> pairs;
  const std::int32_t row = grid.cells_x, layer = row * grid.cells_y;
  for (std::size_t k = 0; k < queries.count; ++k) {
    for (const std::int32_t z : {-layer, 0, layer}) {
      for (const std::int32_t y : {-row, 0, row}) {
        const std::int32_t middle = queries.cell[k] + z + y;
        for (auto j = grid.cell_begin[middle - 1]; j < grid.cell_begin[middle + 2]; ++j) {
          const float dx = grid.x[j] - queries.x[k], dy = grid.y[j] - queries.y[k];
          const float dz = grid.z[j] - queries.z[k];
          const float limit = grid.radius[j] + (queries.radius[k] + grid.reach);
          const std::int32_t a = queries.grain[k], b = grid.grain[j];
          if (dx * dx + dy * dy + dz * dz < limit * limit) {
            pairs.push_back(a < b ? GrainPair{a, b} : GrainPair{b, a});
          }
        }
      }
    }
  }
  return pairs;
}

}  // namespace grainsweep::testing
