#include "engine/measure/solid_fraction.hpp"

#include <algorithm>
#include <cmath>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Number of the column, at most d wide, that holds a coordinate; wraps beyond the box.
std::size_t column_of(double coordinate, double extent, std::size_t columns) {
  const double share = coordinate / extent - std::floor(coordinate / extent);
  return std::min(static_cast<std::size_t>(share * static_cast<double>(columns)), columns - 1);
}

std::size_t columns_along(double extent) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(extent)));
}

/// Median over floor columns of the highest top among the grains that stand above each.
/// `top_of(i)` is the highest point of grain i.
template <class TopOf>
double median_top(const Box& box, const std::vector<Record<double>>& centres, std::size_t grains,
                  TopOf top_of) {
  const std::size_t columns_x = columns_along(box.length), columns_y = columns_along(box.width);
  std::vector<double> highest(columns_x * columns_y, 0.0);
  for (std::size_t i = 0; i < grains; ++i) {
    double& top = highest[column_of(centres[i].y, box.width, columns_y) * columns_x +
                          column_of(centres[i].x, box.length, columns_x)];
    top = std::max(top, top_of(i));
  }
  const auto middle = highest.begin() + static_cast<std::ptrdiff_t>(highest.size() / 2);
  std::nth_element(highest.begin(), middle, highest.end());
  return *middle;
}

}  // namespace

double sphere_slab_volume(double radius, double low, double high) {
  const double a = std::clamp(low, -radius, radius), b = std::clamp(high, -radius, radius);
  const double squared = radius * radius;
  return pi * (b - a) * (squared - (a * a + a * b + b * b) / 3.0);
}

double solid_fraction(const SphereBed& bed, const Slab& slab) {
  double solid = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    solid += sphere_slab_volume(p.w, slab.bottom - p.z, slab.top - p.z);
  }
  return solid / (bed.box.length * bed.box.width * slab.height());
}

double solid_fraction(const ShapeBed& bed, const Slab& slab) {
  double solid = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    solid += slab_volume(bed.shape, bed.pose(i), 2, slab.bottom, slab.top);
  }
  return solid / (bed.box.length * bed.box.width * slab.height());
}

double surface_height(const SphereBed& bed) {
  return median_top(bed.box, bed.position, bed.grains(),
                    [&](std::size_t i) { return bed.position[i].z + bed.position[i].w; });
}

double surface_height(const ShapeBed& bed) {
  return median_top(bed.box, bed.centre, bed.grains(),
                    [&](std::size_t i) { return span_along(bed.shape, bed.pose(i), 2).high; });
}

}  // namespace grainsweep
