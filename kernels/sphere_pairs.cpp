// Broad phase: pairs of spheres that may touch, from a cell-sorted grid.
#include "kernels/lanes.hpp"
#include "kernels/tables.hpp"

namespace {

using grainsweep::SphereGrid;

/// Pairs found so far; those beyond the capacity are counted only.
struct Found {
  GrainPair* pairs;
  std::size_t capacity;
  std::size_t count;

  /// Adds the pairs of grain i with those of a batch of others whose bit is set.
  void add(std::int32_t i, const std::int32_t* others, std::uint32_t lanes) {
    if (count + batch_width<float> <= capacity) {
      put_pairs(i, others, lanes, pairs + count);
    } else {
      add_last(i, others, lanes);
    }
    count += static_cast<std::size_t>(__builtin_popcount(lanes));
  }

 private:
  /// The same where there is no room for a whole batch of pairs.
  void add_last(std::int32_t i, const std::int32_t* others, std::uint32_t lanes) const {
    GrainPair batch[batch_width<float>];
    put_pairs(i, others, lanes, batch);
    const auto added = static_cast<std::size_t>(__builtin_popcount(lanes));
    for (std::size_t k = 0; k < added && count + k < capacity; ++k) pairs[count + k] = batch[k];
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

/// A sphere that looks for others, in all lanes.
struct Seeker {
  Batch<float> x, y, z, reach;  ///< the reach includes its radius
  std::int32_t grain;
};

/// Entries begin .. end of a grid.
struct Run {
  std::int32_t begin, end;
};

/// The entries of three cells in a row.
inline Run three_cells(const SphereGrid& grid, std::int32_t middle) {
  return {grid.cell_begin[middle - 1], grid.cell_begin[middle + 2]};
}

/// Tests a sphere against a run of entries, in their order.
inline void test_run(const SphereGrid& grid, const Seeker& seeker, Run run, Found& found) {
  constexpr std::int32_t width = static_cast<std::int32_t>(batch_width<float>);
  for (std::int32_t at = run.begin; at < run.end; at += width) {
    const std::int32_t left = run.end - at < width ? run.end - at : width;
    const std::uint32_t valid = (1U << left) - 1U;
    const std::uint32_t lanes =
        close_lanes(grid, static_cast<std::size_t>(at), seeker.x, seeker.y, seeker.z, seeker.reach);
    found.add(seeker.grain, grid.grain + at, lanes & valid);
  }
}

/// Tests the spheres of one cell against the rest of the cell, the next one along x, and the four
/// rows of three cells ahead of it: half of all neighbours, so that each pair is met once.
inline void test_cell(const SphereGrid& grid, std::int32_t cell, Found& found) {
  const std::int32_t row = grid.cells_x, layer = grid.cells_x * grid.cells_y;
  const Run own{grid.cell_begin[cell], grid.cell_begin[cell + 1]};
  const Run ahead[4] = {three_cells(grid, cell + row), three_cells(grid, cell + layer - row),
                        three_cells(grid, cell + layer), three_cells(grid, cell + layer + row)};
  const std::int32_t end_of_next = grid.cell_begin[cell + 2];
  for (std::int32_t i = own.begin; i < own.end; ++i) {
    const Seeker seeker{Batch<float>(grid.x[i]), Batch<float>(grid.y[i]), Batch<float>(grid.z[i]),
                        Batch<float>(grid.radius[i] + grid.reach), grid.grain[i]};
    test_run(grid, seeker, {i + 1, end_of_next}, found);
    for (const Run& run : ahead) test_run(grid, seeker, run, found);
  }
}

/// Tests a sphere against the nine rows of three cells around `cell`.
inline void test_around(const SphereGrid& grid, std::int32_t cell, const Seeker& seeker,
                        Found& found) {
  const std::int32_t row = grid.cells_x, layer = grid.cells_x * grid.cells_y;
  for (std::int32_t z = -layer; z <= layer; z += layer) {
    for (std::int32_t y = -row; y <= row; y += row) {
      test_run(grid, seeker, three_cells(grid, cell + z + y), found);
    }
  }
}

}  // namespace

namespace grainsweep::GRAINSWEEP_ISA_NAME {

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

std::size_t sphere_pairs_across(const SphereGrid& grid, const SphereQueries& queries,
                                GrainPair* pairs, std::size_t capacity) {
  Found found{pairs, capacity, 0};
  for (std::size_t k = 0; k < queries.count; ++k) {
    const Seeker seeker{Batch<float>(queries.x[k]), Batch<float>(queries.y[k]),
                        Batch<float>(queries.z[k]), Batch<float>(queries.radius[k] + grid.reach),
                        queries.grain[k]};
    test_around(grid, queries.cell[k], seeker, found);
  }
  return found.count;
}

}  // namespace grainsweep::GRAINSWEEP_ISA_NAME
