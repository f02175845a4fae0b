#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/pair_twin.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

/// A grid of unit cells and its columns.
struct FilledGrid {
  std::int32_t cells_x, cells_y, cells_z;
  std::vector<float> x, y, z, radius;
  std::vector<std::int32_t> grain, cell_begin = {0};

  SphereGrid view(float reach) const {
    return {x.data(),          y.data(), z.data(), radius.data(), grain.data(),
            cell_begin.data(), cells_x,  cells_y,  cells_z,       reach};
  }
};

void add_sphere(FilledGrid& grid, double x, double y, double z, double radius, std::int32_t grain) {
  grid.x.push_back(static_cast<float>(x));
  grid.y.push_back(static_cast<float>(y));
  grid.z.push_back(static_cast<float>(z));
  grid.radius.push_back(static_cast<float>(radius));
  grid.grain.push_back(grain);
}

/// What lies beyond the last entry would be close to everything, were it looked at.
void pad_with_bait(FilledGrid& grid) {
  for (std::size_t k = 0; k < block_width; ++k) {
    add_sphere(grid, 2, 2, 2, 1e6, -1);
  }
}

/// Every cell, border included, holds up to `most` spheres; names are shuffled.
FilledGrid random_grid(std::int32_t nx, std::int32_t ny, std::int32_t nz, std::size_t most,
                       std::uint64_t seed) {
  Draw draw(seed);
  FilledGrid grid{nx, ny, nz, {}, {}, {}, {}, {}};
  for (std::int32_t cell = 0; cell < nx * ny * nz; ++cell) {
    const std::size_t spheres = draw.below(most + 1);
    for (std::size_t k = 0; k < spheres; ++k) {
      add_sphere(grid, cell % nx + draw.unit(), cell / nx % ny + draw.unit(),
                 cell / (nx * ny) + draw.unit(), draw.uniform(0.05, 0.3),
                 static_cast<std::int32_t>(grid.grain.size()));
    }
    grid.cell_begin.push_back(static_cast<std::int32_t>(grid.grain.size()));
  }
  draw.shuffle(grid.grain);
  pad_with_bait(grid);
  return grid;
}

std::vector<GrainPair> found_pairs(const Kernels& kernels, const SphereGrid& grid,
                                   std::size_t capacity) {
  std::vector<GrainPair> pairs(capacity, GrainPair{-7, -7});
  const std::size_t count = kernels.sphere_pairs(grid, pairs.data(), capacity);
  REQUIRE(count <= capacity);
  pairs.resize(count);
  return pairs;
}

TEST_CASE("the broad-phase kernel finds the pairs of its plain-loop twin in the same order") {
  for (const Isa isa : testing::testable_isas()) {
    for (const std::size_t most : {3U, 6U, 40U}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        INFO(name_of(isa) << ", up to " << most << " spheres a cell, seed " << seed);
        const FilledGrid grid = random_grid(5, 4, 6, most, seed);
        const auto expected = testing::sphere_pairs_twin(grid.view(0.05F));
        const auto pairs = found_pairs(kernels_for(isa), grid.view(0.05F), expected.size() + 1);
        CHECK_FALSE(expected.empty());
        REQUIRE(testing::same_bits(pairs, expected));
      }
    }
  }
}

TEST_CASE("pairs beyond the capacity are counted but not written") {
  const FilledGrid grid = random_grid(4, 4, 4, 20, 9);
  const auto expected = testing::sphere_pairs_twin(grid.view(0.1F));
  REQUIRE(expected.size() > 20);
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    std::vector<GrainPair> pairs(20, GrainPair{-7, -7});
    CHECK(kernels_for(isa).sphere_pairs(grid.view(0.1F), pairs.data(), 13) == expected.size());
    CHECK(std::equal(pairs.begin(), pairs.begin() + 13, expected.begin(),
                     [](GrainPair p, GrainPair q) { return testing::same_bits(p, q); }));
    CHECK(std::all_of(pairs.begin() + 13, pairs.end(), [](GrainPair p) { return p.a == -7; }));
    CHECK(kernels_for(isa).sphere_pairs(grid.view(0.1F), nullptr, 0) == expected.size());
  }
}

TEST_CASE("a grid without spheres, or with one, has no pairs") {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    FilledGrid grid = random_grid(3, 3, 3, 0, 1);
    CHECK(found_pairs(kernels_for(isa), grid.view(1), 5).empty());
    FilledGrid lone{3, 3, 3, {}, {}, {}, {}, {}};
    add_sphere(lone, 1.5, 1.5, 1.5, 0.5, 0);
    pad_with_bait(lone);
    lone.cell_begin.resize(28);
    std::fill(lone.cell_begin.begin() + 14, lone.cell_begin.end(), 1);
    CHECK(found_pairs(kernels_for(isa), lone.view(1), 5).empty());
  }
}

TEST_CASE("spheres exactly at the reach are no pair") {
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    FilledGrid grid{3, 3, 3, {}, {}, {}, {}, {}};
    add_sphere(grid, 1, 1, 1, 0.25, 0);
    add_sphere(grid, 1.75, 1, 1, 0.25, 1);
    pad_with_bait(grid);
    grid.cell_begin.resize(28);
    std::fill(grid.cell_begin.begin() + 14, grid.cell_begin.end(), 2);
    CHECK(found_pairs(kernels_for(isa), grid.view(0.25F), 5).empty());
    CHECK(found_pairs(kernels_for(isa), grid.view(0.2500001F), 5).size() == 1);
  }
}

/// Small spheres on their way through the inner cells of a grid, and just outside of them.
struct Queries {
  std::vector<float> x, y, z, radius;
  std::vector<std::int32_t> grain, cell;

  SphereQueries view() const {
    return {x.data(), y.data(), z.data(), radius.data(), grain.data(), cell.data(), grain.size()};
  }
};

Queries random_queries(const FilledGrid& grid, int count, std::uint64_t seed) {
  Draw draw(seed);
  Queries queries;
  const auto inner = [](double at, std::int32_t cells) {
    return std::clamp(static_cast<std::int32_t>(at), 1, cells - 2);
  };
  for (int k = 0; k < count; ++k) {
    const double x = draw.uniform(0.8, grid.cells_x - 0.8);
    const double y = draw.uniform(0.8, grid.cells_y - 0.8);
    const double z = draw.uniform(0.8, grid.cells_z - 0.8);
    queries.x.push_back(static_cast<float>(x));
    queries.y.push_back(static_cast<float>(y));
    queries.z.push_back(static_cast<float>(z));
    queries.radius.push_back(static_cast<float>(draw.uniform(0.01, 0.1)));
    queries.grain.push_back(draw.chance(0.5) ? 100000 + k : -100000 + k);
    queries.cell.push_back((inner(z, grid.cells_z) * grid.cells_y + inner(y, grid.cells_y)) *
                               grid.cells_x +
                           inner(x, grid.cells_x));
  }
  return queries;
}

TEST_CASE("queries find what their plain-loop twin finds, in the same order") {
  for (const Isa isa : testing::testable_isas()) {
    for (const std::size_t most : {1U, 3U, 40U}) {
      INFO(name_of(isa) << ", up to " << most << " spheres a cell");
      const FilledGrid grid = random_grid(5, 4, 6, most, most);
      const Queries queries = random_queries(grid, 300, 5);
      const auto expected = testing::sphere_pairs_across_twin(grid.view(0.05F), queries.view());
      REQUIRE(expected.size() > 8);
      std::vector<GrainPair> pairs(expected.size() + 1, GrainPair{-7, -7});
      const auto& kernels = kernels_for(isa);
      REQUIRE(kernels.sphere_pairs_across(grid.view(0.05F), queries.view(), pairs.data(),
                                          pairs.size()) == expected.size());
      pairs.pop_back();
      REQUIRE(testing::same_bits(pairs, expected));
      std::vector<GrainPair> few(9, GrainPair{-7, -7});
      CHECK(kernels.sphere_pairs_across(grid.view(0.05F), queries.view(), few.data(), 8) ==
            expected.size());
      CHECK(few.back().a == -7);
    }
  }
}

TEST_CASE("queries miss no sphere of the grid, wherever it lies") {
  const FilledGrid grid = random_grid(5, 4, 6, 6, 2);
  const Queries queries = random_queries(grid, 300, 8);
  std::vector<GrainPair> pairs(100000);
  pairs.resize(
      kernels_for(best_isa())
          .sphere_pairs_across(grid.view(0.05F), queries.view(), pairs.data(), pairs.size()));
  std::size_t expected = 0;
  for (std::size_t k = 0; k < queries.grain.size(); ++k) {
    for (std::size_t i = 0; i + block_width < grid.grain.size(); ++i) {
      const float dx = grid.x[i] - queries.x[k], dy = grid.y[i] - queries.y[k];
      const float dz = grid.z[i] - queries.z[k];
      const float limit = grid.radius[i] + (queries.radius[k] + 0.05F);
      expected += dx * dx + dy * dy + dz * dz < limit * limit ? 1 : 0;
    }
  }
  CHECK(pairs.size() == expected);
}

}  // namespace
}  // namespace grainsweep
