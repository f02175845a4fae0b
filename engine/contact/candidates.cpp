#include "engine/contact/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainsweep {

namespace {

/// Cells of the search grid, without the border: `origin` is the corner of the first inner cell.
struct Cells {
  double largest_radius;
  double origin_z;
  double size_x, size_y, size_z;
  std::int32_t inner_x, inner_y, inner_z;

  std::int32_t count() const { return (inner_x + 2) * (inner_y + 2) * (inner_z + 2); }
  /// Cell number of inner coordinates; -1 and `inner` address the border.
  std::int32_t at(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return ((z + 1) * (inner_y + 2) + y + 1) * (inner_x + 2) + x + 1;
  }
};

/// Cells no smaller than `least`, and no more than `most`, which bounds the memory of sparse beds.
std::int32_t cells_along(double extent, double least, double most) {
  return std::max(1, static_cast<std::int32_t>(std::min(extent / least, most)));
}

std::int32_t inner_index(double coordinate, double size, std::int32_t cells) {
  const double cell = std::floor(coordinate / size);
  return static_cast<std::int32_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
}

Cells make_cells(const SphereBed& bed, double reach) {
  double largest = 0.0, bottom = std::numeric_limits<double>::max(), top = -bottom;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    largest = std::max(largest, p.w);
    bottom = std::min(bottom, p.z);
    top = std::max(top, p.z);
  }
  const double least = 2.0 * largest + reach, height = std::max(top - bottom, least);
  constexpr double most_sideways = 512.0;
  Cells cells{largest,
              bottom,
              0,
              0,
              0,
              cells_along(bed.box.length, least, most_sideways),
              cells_along(bed.box.width, least, most_sideways),
              1};
  const double floor_cells = (cells.inner_x + 2.0) * (cells.inner_y + 2.0);
  const double grains = static_cast<double>(bed.grains());
  cells.inner_z = cells_along(height, least, 16.0 + 16.0 * grains / floor_cells);
  cells.size_x = bed.box.length / cells.inner_x;
  cells.size_y = bed.box.width / cells.inner_y;
  cells.size_z = height / cells.inner_z;
  return cells;
}

/// Calls visit(cell, shift_x, shift_y) for the cell of grain position `p` and for each border cell
/// that holds a shifted copy of it.
template <class Visit>
void visit_images(const Cells& cells, const Box& box, const Record<double>& p, Visit visit) {
  const std::int32_t x = inner_index(p.x, cells.size_x, cells.inner_x);
  const std::int32_t y = inner_index(p.y, cells.size_y, cells.inner_y);
  const std::int32_t z = inner_index(p.z - cells.origin_z, cells.size_z, cells.inner_z);
  const bool wraps_x = box.x == Boundary::periodic, wraps_y = box.y == Boundary::periodic;
  for (int j = wraps_y ? -1 : 0; j <= (wraps_y ? 1 : 0); ++j) {
    const std::int32_t image_y = y + j * cells.inner_y;
    if (image_y < -1 || image_y > cells.inner_y) {
      continue;
    }
    for (int i = wraps_x ? -1 : 0; i <= (wraps_x ? 1 : 0); ++i) {
      const std::int32_t image_x = x + i * cells.inner_x;
      if (image_x >= -1 && image_x <= cells.inner_x) {
        visit(cells.at(image_x, image_y, z), i * box.length, j * box.width);
      }
    }
  }
}

/// Turns counts per cell into the first entry of each; returns the number of entries.
std::int32_t to_first_entries(std::vector<std::int32_t>& cell_begin) {
  std::int32_t total = 0;
  for (std::int32_t& entry : cell_begin) {
    const std::int32_t count = entry;
    entry = total;
    total += count;
  }
  return total;
}

void resize_columns(GridColumns& grid, std::int32_t entries) {
  const std::size_t padded = static_cast<std::size_t>(entries) + block_width;
  grid.x.resize(padded);
  grid.y.resize(padded);
  grid.z.resize(padded);
  grid.radius.resize(padded);
  grid.grain.resize(padded);
}

/// Sorts all grains and their border copies into cells (a counting sort: stable, linear).
void fill_columns(const SphereBed& bed, const Cells& cells, GridColumns& grid) {
  grid.cell_begin.assign(static_cast<std::size_t>(cells.count()) + 1, 0);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    visit_images(cells, bed.box, bed.position[i], [&](std::int32_t cell, double, double) {
      ++grid.cell_begin[static_cast<std::size_t>(cell)];
    });
  }
  resize_columns(grid, to_first_entries(grid.cell_begin));
  grid.cell_of.assign(grid.cell_begin.begin(), grid.cell_begin.end());
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    visit_images(cells, bed.box, p, [&](std::int32_t cell, double shift_x, double shift_y) {
      const auto at = static_cast<std::size_t>(grid.cell_of[static_cast<std::size_t>(cell)]++);
      grid.x[at] = static_cast<float>(p.x + shift_x);
      grid.y[at] = static_cast<float>(p.y + shift_y);
      grid.z[at] = static_cast<float>(p.z - cells.origin_z);
      grid.radius[at] = static_cast<float>(p.w);
      grid.grain[at] = static_cast<std::int32_t>(i);
    });
  }
}

/// What rounding positions to f32 can add to a distance, d: three roundings of the largest number.
double rounding_slack(const SphereBed& bed, const Cells& cells) {
  const double extent =
      std::max({2.0 * bed.box.length, 2.0 * bed.box.width, cells.size_z * cells.inner_z});
  return 8.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) * extent;
}

void list_pairs(const SphereBed& bed, const Cells& cells, const Kernels& kernels,
                Candidates& candidates) {
  const GridColumns& g = candidates.grid;
  const SphereGrid grid{
      g.x.data(),        g.y.data(),
      g.z.data(),        g.radius.data(),
      g.grain.data(),    g.cell_begin.data(),
      cells.inner_x + 2, cells.inner_y + 2,
      cells.inner_z + 2, static_cast<float>(candidates.reach + rounding_slack(bed, cells))};
  candidates.pairs.resize(std::max(candidates.pairs.capacity(), 6 * bed.grains() + block_width));
  std::size_t found = kernels.sphere_pairs(grid, candidates.pairs.data(), candidates.pairs.size());
  if (found > candidates.pairs.size()) {
    candidates.pairs.resize(found + found / 4);
    found = kernels.sphere_pairs(grid, candidates.pairs.data(), candidates.pairs.size());
  }
  candidates.pairs.resize(found);
}

void list_walls(const SphereBed& bed, Candidates& candidates) {
  const std::vector<Wall> walls = walls_of(bed.box);
  candidates.walls.resize(walls.size());
  for (std::size_t k = 0; k < walls.size(); ++k) {
    WallCandidates& near = candidates.walls[k];
    near.wall = walls[k];
    near.grains.clear();
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      if (near.wall.gap(bed.position[i]) < candidates.reach) {
        near.grains.push_back(static_cast<std::int32_t>(i));
      }
    }
  }
}

void remember_positions(const SphereBed& bed, const Cells& cells, Candidates& candidates) {
  candidates.built_at.assign(bed.position.begin(), bed.position.end() - 3);
  candidates.layers.resize(static_cast<std::size_t>(cells.inner_z));
  candidates.layer.resize(bed.grains());
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    candidates.layer[i] =
        inner_index(bed.position[i].z - cells.origin_z, cells.size_z, cells.inner_z);
  }
}

void include(Extent& extent, const Record<double>& then, const Record<double>& now) {
  const double at[3] = {now.x - then.x, now.y - then.y, now.z - then.z};
  for (int k = 0; k < 3; ++k) {
    extent.low[k] = extent.empty ? at[k] : std::min(extent.low[k], at[k]);
    extent.high[k] = extent.empty ? at[k] : std::max(extent.high[k], at[k]);
  }
  extent.bottom = extent.empty ? now.z : std::min(extent.bottom, now.z);
  extent.top = extent.empty ? now.z : std::max(extent.top, now.z);
  extent.empty = false;
}

void measure_layers(const SphereBed& bed, Candidates& candidates) {
  std::fill(candidates.layers.begin(), candidates.layers.end(), Extent{{}, {}, 0.0, 0.0, true});
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    include(candidates.layers[static_cast<std::size_t>(candidates.layer[i])],
            candidates.built_at[i], bed.position[i]);
  }
}

double diagonal_of_both(const Extent& a, const Extent& b) {
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double low = std::min(a.empty ? b.low[k] : a.low[k], b.empty ? a.low[k] : b.low[k]);
    const double high = std::max(a.empty ? b.high[k] : a.high[k], b.empty ? a.high[k] : b.high[k]);
    squared += (high - low) * (high - low);
  }
  return std::sqrt(squared);
}

/// Largest relative motion of two grains in the same or in adjacent layers, d.
double relative_motion(const std::vector<Extent>& layers) {
  double worst = 0.0;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const Extent& above = layers[std::min(k + 1, layers.size() - 1)];
    worst = std::max(worst, diagonal_of_both(layers[k], above));
  }
  return worst;
}

/// Least difference in height of two grains that are not in the same or in adjacent layers, d.
double least_rise(const std::vector<Extent>& layers) {
  constexpr double none = std::numeric_limits<double>::max();
  double least = none, top = -none;
  for (std::size_t k = 2; k < layers.size(); ++k) {
    top = layers[k - 2].empty ? top : std::max(top, layers[k - 2].top);
    least = layers[k].empty ? least : std::min(least, layers[k].bottom - top);
  }
  return least;
}

/// Whether a grain that was out of a wall's reach has come near it.
bool has_newcomer(const SphereBed& bed, const Wall& wall, double near,
                  const Candidates& candidates) {
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    if (wall.gap(bed.position[i]) < near && wall.gap(candidates.built_at[i]) >= candidates.reach) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<Wall> walls_of(const Box& box) {
  std::vector<Wall> walls = {{2, 1.0, 0.0}};
  if (box.x == Boundary::walls) {
    walls.push_back({0, 1.0, 0.0});
    walls.push_back({0, -1.0, box.length});
  }
  if (box.y == Boundary::walls) {
    walls.push_back({1, 1.0, 0.0});
    walls.push_back({1, -1.0, box.width});
  }
  return walls;
}

void find_candidates(SphereBed& bed, double reach, const Kernels& kernels, Candidates& candidates) {
  wrap(bed);
  const Cells cells = make_cells(bed, reach);
  candidates.reach = reach;
  candidates.largest_radius = cells.largest_radius;
  fill_columns(bed, cells, candidates.grid);
  list_pairs(bed, cells, kernels, candidates);
  list_walls(bed, candidates);
  remember_positions(bed, cells, candidates);
}

bool still_complete(const SphereBed& bed, double near, Candidates& candidates) {
  measure_layers(bed, candidates);
  return relative_motion(candidates.layers) <= candidates.reach - near &&
         least_rise(candidates.layers) >= 2.0 * candidates.largest_radius + near &&
         std::none_of(
             candidates.walls.begin(), candidates.walls.end(),
             [&](const WallCandidates& w) { return has_newcomer(bed, w.wall, near, candidates); });
}

}  // namespace grainsweep
