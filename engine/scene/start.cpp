#include "engine/scene/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/portable.hpp"
#include "engine/scene/components.hpp"
#include "engine/scene/random.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr std::uint32_t max_attempts = 100000;  // per grain; a few suffice in a wide box
constexpr double column_growth = 1.5;           // where they do not

/// Range of centres along one axis.
struct Range {
  double low, high;
  double at(std::uint32_t word) const { return low + (high - low) * unit_interval(word); }
};

/// A column of cells no smaller than `least_side`, d.
class ColumnCells {
 public:
  ColumnCells(const Box& box, double height, double least_side)
      : extent_{box.length, box.width, height},
        count_{cells(box.length, least_side), cells(box.width, least_side),
               cells(height, least_side)} {}

  int count(std::size_t axis) const { return count_[axis]; }
  std::size_t count() const {
    return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
           static_cast<std::size_t>(count_[2]);
  }
  int index(std::size_t axis, double coordinate) const {
    return std::clamp(static_cast<int>(coordinate / extent_[axis] * count_[axis]), 0,
                      count_[axis] - 1);
  }
  /// How many cells away a place at this distance may be.
  int cells_to(std::size_t axis, double reach) const {
    return std::min(count_[axis],
                    static_cast<int>(std::ceil(reach * count_[axis] / extent_[axis])));
  }
  std::size_t at(int x, int y, int z) const {
    const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) +
                     static_cast<std::size_t>(y);
    return row * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(x);
  }
  std::size_t cell_of(const PlacedSphere& s) const {
    return at(index(0, s.x), index(1, s.y), index(2, s.z));
  }

 private:
  static int cells(double extent, double side) {
    return std::max(1, static_cast<int>(extent / side));
  }

  double extent_[3];
  int count_[3];
};

/// Side of the cells for so many spheres of up to this diameter: for few spheres in a wide box
/// there are not many more cells than spheres.
double side_for(std::size_t spheres, double diameter, const Box& box, double height) {
  const double most_cells = 4.0 * static_cast<double>(spheres) + 64.0;
  return std::max(diameter, portable::cbrt(box.length * box.width * height / most_cells));
}

/// Spheres placed so far, of which there will be `spheres` of up to this diameter.
class Column {
 public:
  Column(const Box& box, double height, double largest_diameter, std::size_t spheres)
      : box_(box),
        largest_radius_(largest_diameter / 2.0),
        cells_(box, height, side_for(spheres, largest_diameter, box, height)),
        cell_(cells_.count()) {}

  bool has_room_for(const PlacedSphere& s) const {
    const double reach = s.radius + largest_radius_;
    const int x = cells_.index(0, s.x), y = cells_.index(1, s.y), z = cells_.index(2, s.z);
    const int far_x = cells_.cells_to(0, reach), far_y = cells_.cells_to(1, reach);
    const int far_z = cells_.cells_to(2, reach);
    if (overlaps_cell(s, x, y, z)) return false;  // the likeliest one
    for (int k = std::max(z - far_z, 0); k <= std::min(z + far_z, cells_.count(2) - 1); ++k) {
      for (int j = y - far_y; j <= y + far_y; ++j) {
        for (int i = x - far_x; i <= x + far_x; ++i) {
          if (overlaps_cell(s, i, j, k)) {
            return false;
          }
        }
      }
    }
    return true;
  }

  void add(const PlacedSphere& s) { cell_[cells_.cell_of(s)].push_back(s); }

 private:
  /// Cells beyond a periodic border are those of the other side; beyond a wall there are none.
  bool overlaps_cell(const PlacedSphere& s, int x, int y, int z) const {
    const int cells_x = cells_.count(0), cells_y = cells_.count(1);
    const bool outside_x = x < 0 || x >= cells_x, outside_y = y < 0 || y >= cells_y;
    if ((outside_x && box_.x == Boundary::walls) || (outside_y && box_.y == Boundary::walls)) {
      return false;
    }
    const auto& cell = cell_[cells_.at(wrapped(x, cells_x), wrapped(y, cells_y), z)];
    return std::any_of(cell.begin(), cell.end(),
                       [&](const PlacedSphere& other) { return overlap(s, other); });
  }
  bool overlap(const PlacedSphere& a, const PlacedSphere& b) const {
    const double dx = nearest_image(a.x - b.x, box_.period_x());
    const double dy = nearest_image(a.y - b.y, box_.period_y());
    const double dz = a.z - b.z, reach = a.radius + b.radius;
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }
  /// Index on the other side of a periodic border; `index` lies no further out than `cells`.
  static int wrapped(int index, int cells) {
    return index < 0 ? index + cells : index >= cells ? index - cells : index;
  }

  Box box_;
  double largest_radius_;
  ColumnCells cells_;
  std::vector<std::vector<PlacedSphere>> cell_;
};

Range centres(double extent, Boundary boundary, double radius) {
  return boundary == Boundary::walls ? Range{radius, extent - radius} : Range{0.0, extent};
}

/// Whether a sphere whose centre is random in the box around the tube lies in the tube.
bool is_in_tube(const Box& box, double radius, const PlacedSphere& sphere) {
  const double x = sphere.x - box.length / 2.0, y = sphere.y - box.width / 2.0;
  const double reach = box.length / 2.0 - radius;
  return x * x + y * y <= reach * reach;
}

/// A place where a grain overlaps nothing in any column; none if no room was found.
std::optional<NumberedSphere> place(const std::vector<Column>& columns, const Box& box,
                                    double height, double radius, std::uint64_t key,
                                    std::uint64_t grain) {
  const Range x = centres(box.length, box.x, radius), y = centres(box.width, box.y, radius);
  const Range z = {radius, height - radius};
  for (std::uint32_t attempt = 0; attempt < max_attempts; ++attempt) {
    const auto words = random_words(key, Purpose::place, grain, attempt);
    const NumberedSphere sphere{{x.at(words[0]), y.at(words[1]), z.at(words[2]), radius}, grain};
    if (box.is_tube && !is_in_tube(box, radius, sphere)) continue;
    const bool has_room = std::all_of(columns.begin(), columns.end(), [&](const Column& column) {
      return column.has_room_for(sphere);
    });
    if (has_room) {
      return sphere;
    }
  }
  return std::nullopt;
}

/// Largest diameter of all grains, then of those less than half as large, and so on: grains of each
/// of these sizes have a column of their own, so that no cell holds hundreds of small ones.
std::vector<double> column_diameters(const std::vector<double>& radii) {
  std::vector<double> diameters;
  double below = infinity;
  for (;;) {
    double largest = 0.0;
    for (const double radius : radii) {
      if (radius < below) largest = std::max(largest, radius);
    }
    if (largest == 0.0) return diameters;
    diameters.push_back(2.0 * largest);
    below = largest / 2.0;
  }
}

/// The column, of those of `column_diameters`, for a grain of this diameter.
std::size_t column_for(double diameter, const std::vector<double>& diameters) {
  std::size_t column = diameters.size() - 1;
  while (diameter > diameters[column]) --column;
  return column;
}

double solid_volume(const std::vector<double>& radii) {
  double volume = 0.0;
  for (const double radius : radii) volume += sphere_volume(radius);
  return volume;
}

/// The grains of a start of polyhedra, in the order in which they are drawn.
struct DrawnGrains {
  std::vector<ConvexShape> shapes;
  std::vector<std::uint8_t> components;  ///< of each grain; empty if there is one shape
  std::vector<double> radii;             ///< half their scales, d

  const ConvexShape& shape(std::size_t i) const {
    return shapes[components.empty() ? 0 : components[i]];
  }
  /// Radius of the ball that keeps a grain from others, at size 1, d.
  double ball(std::size_t i) const {
    return start_ball * portable::cbrt(shape(i).volume / sphere_volume(1.0));
  }
};

DrawnGrains draw_grains(const PackingSpec& spec) {
  DrawnGrains grains{shapes_of(spec.shape), {}, draw_radii(spec)};
  grains.components = draw_components(spec.shape, grains.radii.size(), spec.random_key);
  return grains;
}

double solid_volume(const DrawnGrains& grains) {
  double volume = 0.0;
  for (std::size_t i = 0; i < grains.radii.size(); ++i) {
    volume += grains.shape(i).volume_at(2.0 * grains.radii[i]);
  }
  return volume;
}

std::vector<double> ball_radii(const DrawnGrains& grains) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < grains.radii.size(); ++i) {
    radii.push_back(grains.radii[i] * (2.0 * grains.ball(i)));
  }
  return radii;
}

/// Numbers the grains of a large bed along the axis of its subdomains, slice by slice, and within
/// each in their previous order: the grains of a subdomain lie together in memory.
template <class Kind>
void sort_along_subdomains(const Box& box, double solid_volume, double largest_radius,
                           std::vector<NumberedSphere>& spheres) {
  const int axis = subdomain_axis(box, solid_volume);
  if (max_subdomains<Kind>(spheres.size()) == 1 || axis == 2) return;
  const double slice = 2.0 * largest_radius;
  const auto slice_of = [&](const PlacedSphere& s) {
    return std::floor((axis == 0 ? s.x : s.y) / slice);
  };
  std::stable_sort(
      spheres.begin(), spheres.end(),
      [&](const PlacedSphere& a, const PlacedSphere& b) { return slice_of(a) < slice_of(b); });
}

bool has_width_for(double radius, const Box& box) {
  const Range x = centres(box.length, box.x, radius), y = centres(box.width, box.y, radius);
  return x.low <= x.high && y.low <= y.high;
}

/// Cell by cell from the floor up, within each in their previous order: neighbours in space get
/// neighbouring numbers.
void sort_by_place(const ColumnCells& cells, std::vector<NumberedSphere>& spheres) {
  std::stable_sort(spheres.begin(), spheres.end(),
                   [&](const PlacedSphere& a, const PlacedSphere& b) {
                     return cells.cell_of(a) < cells.cell_of(b);
                   });
}

/// Spheres placed in a column of this height; nothing if one found no room.
std::optional<std::vector<NumberedSphere>> fill_column(const Box& box,
                                                       const std::vector<double>& radii,
                                                       double height, std::uint64_t key) {
  const std::vector<double> diameters = column_diameters(radii);
  std::vector<std::size_t> counts(diameters.size(), 0);
  for (const double radius : radii) ++counts[column_for(2.0 * radius, diameters)];
  std::vector<Column> columns;
  columns.reserve(diameters.size());
  for (std::size_t k = 0; k < diameters.size(); ++k) {
    columns.emplace_back(box, height, diameters[k], counts[k]);
  }
  std::vector<NumberedSphere> placed;
  placed.reserve(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto sphere = place(columns, box, height, radii[i], key, i);
    if (!sphere) {
      return std::nullopt;
    }
    columns[column_for(2.0 * radii[i], diameters)].add(*sphere);
    placed.push_back(*sphere);
  }
  sort_by_place(ColumnCells(box, height, diameters.front()), placed);
  return placed;
}

/// A point in the unit disc, uniform.
struct DiscPoint {
  double x, y, squared;
};
DiscPoint disc_point(std::uint32_t a, std::uint32_t b) {
  const double x = 2.0 * unit_interval(a) - 1.0, y = 2.0 * unit_interval(b) - 1.0;
  return {x, y, x * x + y * y};
}

/// Uniform over all rotations, from two points in the unit disc (Marsaglia 1972).
Quaternion random_orientation(std::uint64_t key, std::uint64_t grain) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const auto words = random_words(key, Purpose::orientation, grain, attempt);
    const DiscPoint p = disc_point(words[0], words[1]), q = disc_point(words[2], words[3]);
    if (p.squared < 1.0 && q.squared < 1.0) {
      const double share = std::sqrt((1.0 - p.squared) / q.squared);
      return Quaternion(p.x, p.y, share * q.x, share * q.y).normalized();
    }
  }
}

/// Placed grains, whose orientations are given for the shapes as they are written.
PolyhedronBed placed_bed(const PackingSpec& spec, const PlacedGrains& placed) {
  std::vector<ConvexShape> shapes = shapes_of(spec.shape);
  const bool are_mixed = std::holds_alternative<Mixture>(spec.shape);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const PlacedSphere& grain = placed.grains[i];
    const auto& [x, y, z, w] = placed.orientations[i];
    const Quaternion rotation(shapes[are_mixed ? placed.components[i] : 0].given.rotation);
    poses.push_back({{grain.x, grain.y, grain.z},
                     2.0 * grain.radius,
                     (Quaternion(w, x, y, z) * rotation).normalized()});
  }
  return make_bed(spec.box, std::move(shapes),
                  are_mixed ? placed.components : std::vector<std::uint8_t>(), poses);
}

/// Whether a tube is so narrow that its grains come to rest in single file, each touching only the
/// wall and two others.
bool is_single_file(const Box& box, const std::vector<double>& radii) {
  const double smallest = *std::min_element(radii.begin(), radii.end());
  return box.is_tube && box.length <= (2.0 + std::sqrt(3.0)) * smallest;
}

/// Grains of a single file, from the floor up: in a plane through the axis, on either side in turn.
std::vector<PlacedSphere> place_in_file(const Box& box, const std::vector<double>& radii,
                                        double min_height, std::uint64_t key) {
  constexpr double jitter = 0.1;
  const double largest = *std::max_element(radii.begin(), radii.end());
  const double apart = std::max(2.0 * largest, min_height / static_cast<double>(radii.size()));
  const auto share_of = [&](std::uint64_t grain) {
    return unit_interval(random_words(key, Purpose::place, grain, 0)[0]);
  };
  const double angle = 2.0 * pi * share_of(radii.size()), middle = box.length / 2.0;
  std::vector<PlacedSphere> spheres;
  double side = 1.0, z = apart;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double from_axis = side * (middle - radii[i]);
    spheres.push_back({middle + from_axis * portable::cos(angle),
                       middle + from_axis * portable::sin(angle), z, radii[i]});
    z += apart * (1.0 + jitter * share_of(i));
    side = -side;
  }
  return spheres;
}

}  // namespace

std::optional<std::vector<NumberedSphere>> place_at_random(const Box& box,
                                                           const std::vector<double>& radii,
                                                           double min_height, std::uint64_t key) {
  const double largest = *std::max_element(radii.begin(), radii.end());
  if (!has_width_for(largest, box)) return std::nullopt;
  for (double height = std::max(min_height, 3.0 * largest);; height *= column_growth) {
    if (auto spheres = fill_column(box, radii, height, key)) return spheres;
  }
}

template <>
std::optional<SphereBed> start(const PackingSpec& spec) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return make_bed(spec.box, placed->grains);
  }
  std::vector<double> radii = draw_radii(spec);
  if (radii.empty()) return make_bed(spec.box, {});
  const double volume = solid_volume(radii);
  const double floor = spec.box.floor_area();
  const double height = volume / (sphere_start_solid_fraction * floor);
  if (is_single_file(spec.box, radii)) {
    shuffle(spec.random_key, Purpose::order, radii);  // grains in a file cannot pass each other
    return make_bed(spec.box, place_in_file(spec.box, radii, height, spec.random_key));
  }
  auto spheres = place_at_random(spec.box, radii, height, spec.random_key);
  if (!spheres) return std::nullopt;
  sort_along_subdomains<Sphere>(spec.box, volume, *std::max_element(radii.begin(), radii.end()),
                                *spheres);
  return make_bed(spec.box, std::vector<PlacedSphere>(spheres->begin(), spheres->end()));
}

template <>
std::optional<PolyhedronBed> start(const PackingSpec& spec) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) return placed_bed(spec, *placed);
  DrawnGrains grains = draw_grains(spec);
  std::vector<Pose> poses;
  if (grains.radii.empty()) return make_bed(spec.box, std::move(grains.shapes), {}, poses);
  const double volume = solid_volume(grains);
  const double height = volume / (polyhedron_start_solid_fraction * spec.box.floor_area());
  const std::vector<double> radii = ball_radii(grains);
  auto balls = place_at_random(spec.box, radii, height, spec.random_key);
  if (!balls) return std::nullopt;
  sort_along_subdomains<Polyhedron>(spec.box, volume, *std::max_element(radii.begin(), radii.end()),
                                    *balls);
  std::vector<std::uint8_t> components;
  for (const NumberedSphere& s : *balls) {
    poses.push_back({{s.x, s.y, s.z},
                     s.radius / grains.ball(s.number),
                     random_orientation(spec.random_key, poses.size())});
    if (!grains.components.empty()) components.push_back(grains.components[s.number]);
  }
  return make_bed(spec.box, std::move(grains.shapes), std::move(components), poses);
}

}  // namespace grainsweep
