#include "engine/broad/grid.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

/// Cells no smaller than `least`, and no more than `most`, which bounds the memory of sparse beds.
std::int32_t cells_along(double extent, double least, double most) {
  return std::max(1, static_cast<std::int32_t>(std::min(extent / least, most)));
}

std::int32_t inner_index(double coordinate, double size, std::int32_t cells) {
  return static_cast<std::int32_t>(
      std::clamp(coordinate / size, 0.0, static_cast<double>(cells - 1)));
}

/// Periods by which a grain's copies are shifted along an axis.
struct Turns {
  int least, most;
};

/// Only a grain in the first or the last cell has a copy in the border cell on the other side.
Turns turns_of(std::int32_t index, std::int32_t cells, bool wraps) {
  return {wraps && index == cells - 1 ? -1 : 0, wraps && index == 0 ? 1 : 0};
}

/// Appends the grain at `p` in its cell and in each border cell that holds a shifted copy of it.
void append_images(const Cells& cells, const Box& box, const Record<double>& p, std::int32_t grain,
                   std::vector<GridImage>& images) {
  const std::int32_t x = cells.place_along(0, p), y = cells.place_along(1, p);
  const std::int32_t z = cells.place_along(2, p);
  const Turns turns_x = turns_of(x, cells.inner_x, box.x == Boundary::periodic);
  const Turns turns_y = turns_of(y, cells.inner_y, box.y == Boundary::periodic);
  for (int j = turns_y.least; j <= turns_y.most; ++j) {
    for (int i = turns_x.least; i <= turns_x.most; ++i) {
      const std::int32_t cell = cells.at(x + i * cells.inner_x, y + j * cells.inner_y, z);
      images.push_back({grain, cell, i, j, 0});
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

/// A counting sort of all images by cell.
void choose_entries(const Cells& cells, GridColumns& grid) {
  grid.cell_begin.assign(static_cast<std::size_t>(cells.count()) + 1, 0);
  for (const std::vector<GridImage>& images : grid.images) {
    for (const GridImage& image : images) {
      ++grid.cell_begin[static_cast<std::size_t>(image.cell)];
    }
  }
  resize_columns(grid, to_first_entries(grid.cell_begin));
  grid.next_entry.assign(grid.cell_begin.begin(), grid.cell_begin.end());
  for (std::vector<GridImage>& images : grid.images) {
    for (GridImage& image : images) {
      image.entry = grid.next_entry[static_cast<std::size_t>(image.cell)]++;
    }
  }
}

void fill_entry(const Balls& balls, const Cells& cells, const GridImage& image, GridColumns& grid) {
  const Record<double>& p = balls.ball[static_cast<std::size_t>(image.grain)];
  const auto at = static_cast<std::size_t>(image.entry);
  grid.x[at] = static_cast<float>(p.x + image.turns_x * balls.bed.box.length);
  grid.y[at] = static_cast<float>(p.y + image.turns_y * balls.bed.box.width);
  grid.z[at] = static_cast<float>(p.z - cells.origin_z);
  grid.radius[at] = static_cast<float>(p.w);
  grid.grain[at] = image.grain;
}

}  // namespace

std::int32_t Cells::place_along(int axis, const Record<double>& sphere) const {
  return axis == 0   ? inner_index(sphere.x, size_x, inner_x)
         : axis == 1 ? inner_index(sphere.y, size_y, inner_y)
                     : inner_index(sphere.z - origin_z, size_z, inner_z);
}

std::int32_t Cells::cell_of(const Record<double>& sphere) const {
  return at(place_along(0, sphere), place_along(1, sphere), place_along(2, sphere));
}

Cells make_cells(const Box& box, double bottom, double top, double least, std::size_t grains) {
  const double height = std::max(top - bottom, least);
  const auto number = static_cast<double>(grains);
  const double max_sideways = std::min(512.0, 64.0 + 4.0 * std::sqrt(number));
  Cells cells;
  cells.origin_z = bottom;
  cells.inner_x = cells_along(box.length, least, max_sideways);
  cells.inner_y = cells_along(box.width, least, max_sideways);
  const double floor_cells = (cells.inner_x + 2.0) * (cells.inner_y + 2.0);
  cells.inner_z = cells_along(height, least, 16.0 + 16.0 * number / floor_cells);
  cells.size_x = box.length / cells.inner_x;
  cells.size_y = box.width / cells.inner_y;
  cells.size_z = height / cells.inner_z;
  return cells;
}

void fill_columns(const Balls& balls, const std::vector<std::int32_t>& members, const Cells& cells,
                  const ParallelFor& loop, GridColumns& grid) {
  grid.images.resize(balls.bed.subdomains);
  parallel_chunks(
      loop, members.size(), balls.bed.subdomains, [&](std::size_t part, IndexRange share) {
        grid.images[part].clear();
        for (std::size_t k = share.first; k < share.last; ++k) {
          append_images(cells, balls.bed.box, balls.ball[static_cast<std::size_t>(members[k])],
                        members[k], grid.images[part]);
        }
      });
  choose_entries(cells, grid);
  parallel_for(loop, balls.bed.subdomains, [&](std::size_t part) {
    for (const GridImage& image : grid.images[part]) fill_entry(balls, cells, image, grid);
  });
}

SphereGrid view_of(const GridColumns& grid, const Cells& cells, float reach) {
  return {grid.x.data(),     grid.y.data(),
          grid.z.data(),     grid.radius.data(),
          grid.grain.data(), grid.cell_begin.data(),
          cells.inner_x + 2, cells.inner_y + 2,
          cells.inner_z + 2, reach};
}

}  // namespace grainsweep
