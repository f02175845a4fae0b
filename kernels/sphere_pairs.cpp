// Broad phase: pairs of spheres that may touch, from a cell-sorted grid.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::GrainPair;
using grainsweep::SphereGrid;

/// Pairs found so far; those beyond the capacity are counted only.
struct Found {
  GrainPair* pairs;
  std::size_t capacity;
  std::size_t count;

  void add(std::int32_t i, std::int32_t j) {
    if (count < capacity) {
      pairs[count] = i < j ? GrainPair{i, j} : GrainPair{j, i};
    }
    ++count;
  }
};

/// Lanes of the batch at entry `at` whose spheres come closer to sphere (x, y, z) than `reach`,
/// which includes that sphere's radius.
inline std::uint32_t close_lanes(const SphereGrid& grid, std::size_t at, const Batch<float>& x,
                                 const Batch<float>& y, const Batch<float>& z,
                                 const Batch<float>& reach) {
  const Batch<float> dx = load(grid.x + at) - x;
  const Batch<float> dy = load(grid.y + at) - y;
  const Batch<float> dz = load(grid.z + at) - z;
  const Batch<float> limit = load(grid.radius + at) + reach;
  return bits_of(dx * dx + dy * dy + dz * dz < limit * limit);
}

/// Tests the sphere at entry `i` against entries begin .. end, in their order.
inline void test_run(const SphereGrid& grid, std::int32_t i, std::int32_t begin, std::int32_t end,
                     Found& found) {
  const Batch<float> x(grid.x[i]), y(grid.y[i]), z(grid.z[i]);
  const Batch<float> reach(grid.radius[i] + grid.reach);
  constexpr std::int32_t width = static_cast<std::int32_t>(batch_width<float>);
  for (std::int32_t at = begin; at < end; at += width) {
    std::uint32_t lanes = close_lanes(grid, static_cast<std::size_t>(at), x, y, z, reach);
    if (end - at < width) {
      lanes &= (1U << (end - at)) - 1U;
    }
    for (; lanes != 0; lanes &= lanes - 1) {
      found.add(grid.grain[i], grid.grain[at + __builtin_ctz(lanes)]);
    }
  }
}

/// Tests the spheres of one cell against the rest of the cell, the next one along x, and the four
/// rows of three cells ahead of it: half of all neighbours, so that each pair is met once.
inline void test_cell(const SphereGrid& grid, std::int32_t cell, Found& found) {
  const std::int32_t row = grid.cells_x, layer = grid.cells_x * grid.cells_y;
  const std::int32_t ahead[4] = {cell + row, cell + layer - row, cell + layer, cell + layer + row};
  for (std::int32_t i = grid.cell_begin[cell]; i < grid.cell_begin[cell + 1]; ++i) {
    test_run(grid, i, i + 1, grid.cell_begin[cell + 2], found);
    for (const std::int32_t middle : ahead) {
      test_run(grid, i, grid.cell_begin[middle - 1], grid.cell_begin[middle + 2], found);
    }
  }
}

std::size_t sphere_pairs(const SphereGrid& grid, GrainPair* pairs, std::size_t capacity) {
  Found found{pairs, capacity, 0};
  for (std::int32_t z = 1; z + 1 < grid.cells_z; ++z) {
    for (std::int32_t y = 1; y + 1 < grid.cells_y; ++y) {
      const std::int32_t row = (z * grid.cells_y + y) * grid.cells_x;
      for (std::int32_t x = 1; x + 1 < grid.cells_x; ++x) {
        test_cell(grid, row + x, found);
      }
    }
  }
  return found.count;
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {
extern const SpherePairs sphere_pairs = ::sphere_pairs;
}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
