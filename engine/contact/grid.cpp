#include "engine/contact/grid.hpp"

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

/// Appends the grain at `p` in its cell and in each border cell that holds a shifted copy of it.
void append_images(const Cells& cells, const Box& box, const Record<double>& p, std::int32_t grain,
                   std::vector<GridImage>& images) {
  const std::int32_t x = inner_index(p.x, cells.size_x, cells.inner_x);
  const std::int32_t y = inner_index(p.y, cells.size_y, cells.inner_y);
  const std::int32_t z = cells.layer_of(p);
  const bool wraps_x = box.x == Boundary::periodic, wraps_y = box.y == Boundary::periodic;
  for (int j = wraps_y ? -1 : 0; j <= (wraps_y ? 1 : 0); ++j) {
    const std::int32_t image_y = y + j * cells.inner_y;
    if (image_y < -1 || image_y > cells.inner_y) {
      continue;
    }
    for (int i = wraps_x ? -1 : 0; i <= (wraps_x ? 1 : 0); ++i) {
      const std::int32_t image_x = x + i * cells.inner_x;
      if (image_x >= -1 && image_x <= cells.inner_x) {
        images.push_back({grain, cells.at(image_x, image_y, z), i, j});
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

}  // namespace

std::int32_t Cells::layer_of(const Record<double>& sphere) const {
  return inner_index(sphere.z - origin_z, size_z, inner_z);
}

std::int32_t Cells::cell_of(const Record<double>& sphere) const {
  return at(inner_index(sphere.x, size_x, inner_x), inner_index(sphere.y, size_y, inner_y),
            layer_of(sphere));
}

Cells make_cells(const Box& box, double bottom, double top, double least, std::size_t grains) {
  const double height = std::max(top - bottom, least);
  const auto number = static_cast<double>(grains);
  const double most_sideways = std::min(512.0, 64.0 + 4.0 * std::sqrt(number));
  Cells cells;
  cells.origin_z = bottom;
  cells.inner_x = cells_along(box.length, least, most_sideways);
  cells.inner_y = cells_along(box.width, least, most_sideways);
  const double floor_cells = (cells.inner_x + 2.0) * (cells.inner_y + 2.0);
  cells.inner_z = cells_along(height, least, 16.0 + 16.0 * number / floor_cells);
  cells.size_x = box.length / cells.inner_x;
  cells.size_y = box.width / cells.inner_y;
  cells.size_z = height / cells.inner_z;
  return cells;
}

void fill_columns(const SphereBed& bed, const std::vector<std::int32_t>& members,
                  const Cells& cells, GridColumns& grid) {
  grid.images.clear();
  grid.cell_begin.assign(static_cast<std::size_t>(cells.count()) + 1, 0);
  for (const std::int32_t grain : members) {
    append_images(cells, bed.box, bed.position[static_cast<std::size_t>(grain)], grain,
                  grid.images);
  }
  for (const GridImage& image : grid.images) {
    ++grid.cell_begin[static_cast<std::size_t>(image.cell)];
  }
  resize_columns(grid, to_first_entries(grid.cell_begin));
  grid.next_entry.assign(grid.cell_begin.begin(), grid.cell_begin.end());
  for (const GridImage& image : grid.images) {
    const Record<double>& p = bed.position[static_cast<std::size_t>(image.grain)];
    const auto at =
        static_cast<std::size_t>(grid.next_entry[static_cast<std::size_t>(image.cell)]++);
    grid.x[at] = static_cast<float>(p.x + image.turns_x * bed.box.length);
    grid.y[at] = static_cast<float>(p.y + image.turns_y * bed.box.width);
    grid.z[at] = static_cast<float>(p.z - cells.origin_z);
    grid.radius[at] = static_cast<float>(p.w);
    grid.grain[at] = image.grain;
  }
}

SphereGrid view_of(const GridColumns& grid, const Cells& cells, float reach) {
  return {grid.x.data(),     grid.y.data(),
          grid.z.data(),     grid.radius.data(),
          grid.grain.data(), grid.cell_begin.data(),
          cells.inner_x + 2, cells.inner_y + 2,
          cells.inner_z + 2, reach};
}

}  // namespace grainsweep
