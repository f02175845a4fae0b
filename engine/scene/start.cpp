#include "engine/scene/start.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/random.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr std::uint32_t most_attempts = 100000;  // per grain; a few suffice at this solid fraction

/// Range of centres along one axis.
struct Range {
  double low, high;
  double at(std::uint32_t word) const { return low + (high - low) * unit_interval(word); }
};

/// Spheres placed so far, in cells no smaller than the largest diameter.
class Column {
 public:
  Column(const Box& box, double height, double largest_diameter)
      : box_(box),
        cells_x_(cells(box.length, largest_diameter)),
        cells_y_(cells(box.width, largest_diameter)),
        cells_z_(cells(height, largest_diameter)),
        height_(height),
        cell_(static_cast<std::size_t>(cells_x_ * cells_y_ * cells_z_)) {}

  bool has_room_for(const PlacedSphere& s) const {
    const int x = index(s.x, box_.length, cells_x_), y = index(s.y, box_.width, cells_y_);
    const int z = index(s.z, height_, cells_z_);
    for (int k = std::max(z - 1, 0); k <= std::min(z + 1, cells_z_ - 1); ++k) {
      for (int j = y - 1; j <= y + 1; ++j) {
        for (int i = x - 1; i <= x + 1; ++i) {
          if (overlaps_cell(s, i, j, k)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  void add(const PlacedSphere& s) {
    cell_[at(index(s.x, box_.length, cells_x_), index(s.y, box_.width, cells_y_),
             index(s.z, height_, cells_z_))]
        .push_back(s);
  }

  /// All spheres, cell by cell from the floor up: neighbours in space get neighbouring numbers.
  std::vector<PlacedSphere> sorted() const {
    std::vector<PlacedSphere> all;
    for (const auto& cell : cell_) {
      all.insert(all.end(), cell.begin(), cell.end());
    }
    return all;
  }

 private:
  static int cells(double extent, double size) {
    return std::max(1, static_cast<int>(extent / size));
  }
  static int index(double coordinate, double extent, int cells) {
    return std::clamp(static_cast<int>(coordinate / extent * cells), 0, cells - 1);
  }
  std::size_t at(int x, int y, int z) const {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_y_) +
                     static_cast<std::size_t>(y);
    return row * static_cast<std::size_t>(cells_x_) + static_cast<std::size_t>(x);
  }
  /// Cells beyond a periodic border are those of the other side; beyond a wall there are none.
  bool overlaps_cell(const PlacedSphere& s, int x, int y, int z) const {
    const bool outside_x = x < 0 || x >= cells_x_, outside_y = y < 0 || y >= cells_y_;
    if ((outside_x && box_.x == Boundary::walls) || (outside_y && box_.y == Boundary::walls)) {
      return false;
    }
    const auto& cell = cell_[at((x + cells_x_) % cells_x_, (y + cells_y_) % cells_y_, z)];
    return std::any_of(cell.begin(), cell.end(),
                       [&](const PlacedSphere& other) { return overlap(s, other); });
  }
  bool overlap(const PlacedSphere& a, const PlacedSphere& b) const {
    const double dx = nearest(a.x - b.x, box_.period_x());
    const double dy = nearest(a.y - b.y, box_.period_y());
    const double dz = a.z - b.z, reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }
  static double nearest(double difference, double period) {
    return period > 0.0 ? difference - period * std::nearbyint(difference / period) : difference;
  }

  Box box_;
  int cells_x_, cells_y_, cells_z_;
  double height_;
  std::vector<std::vector<PlacedSphere>> cell_;
};

Range centres(double extent, Boundary boundary, double radius) {
  return boundary == Boundary::walls ? Range{radius, extent - radius} : Range{0.0, extent};
}

/// Places one grain; false if no room was found.
bool place(Column& column, const Box& box, double height, double radius, std::uint64_t key,
           std::uint64_t grain) {
  const Range x = centres(box.length, box.x, radius), y = centres(box.width, box.y, radius);
  const Range z = {radius, height - radius};
  if (x.high < x.low || y.high < y.low) {
    return false;
  }
  for (std::uint32_t attempt = 0; attempt < most_attempts; ++attempt) {
    const auto words = random_words(key, Purpose::place, grain, attempt);
    const PlacedSphere sphere{x.at(words[0]), y.at(words[1]), z.at(words[2]), radius};
    if (column.has_room_for(sphere)) {
      column.add(sphere);
      return true;
    }
  }
  return false;
}

double column_height(const Box& box, const std::vector<double>& radii, double largest_diameter) {
  double volume = 0.0;
  for (const double radius : radii) {
    volume += sphere_volume(radius);
  }
  return std::max(volume / (start_solid_fraction * box.length * box.width), 1.5 * largest_diameter);
}

std::optional<SphereBed> place_all(const Box& box, const std::vector<double>& radii,
                                   std::uint64_t key) {
  const double largest = 2.0 * *std::max_element(radii.begin(), radii.end());
  const double height = column_height(box, radii, largest);
  Column column(box, height, largest);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (!place(column, box, height, radii[i], key, i)) {
      return std::nullopt;
    }
  }
  return make_bed(box, column.sorted());
}

}  // namespace

std::optional<SphereBed> start(const PackingSpec& spec) {
  const Box box{spec.box.length, spec.box.width, spec.box.x, spec.box.y};
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return make_bed(box, placed->grains);
  }
  const std::vector<double> radii = draw_radii(spec);
  return radii.empty() ? make_bed(box, {}) : place_all(box, radii, spec.random_key);
}

}  // namespace grainsweep
