#include "engine/measure/solid_fraction.hpp"

#include <algorithm>
#include <cmath>

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

double surface_height(const SphereBed& bed) {
  const std::size_t columns_x = columns_along(bed.box.length);
  const std::size_t columns_y = columns_along(bed.box.width);
  std::vector<double> highest(columns_x * columns_y, 0.0);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    double& top = highest[column_of(p.y, bed.box.width, columns_y) * columns_x +
                          column_of(p.x, bed.box.length, columns_x)];
    top = std::max(top, p.z + p.w);
  }
  const auto middle = highest.begin() + static_cast<std::ptrdiff_t>(highest.size() / 2);
  std::nth_element(highest.begin(), middle, highest.end());
  return *middle;
}

}  // namespace grainsweep
