#include "engine/measure/solid_fraction.hpp"

#include <algorithm>
#include <cmath>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Least width of a floor column, d: that of the grains that fill most of the bed, if it is larger
/// than d, since else most columns would have no grain's centre above them.
template <class Kind>
double least_column(const Bed<Kind>& bed) {
  constexpr double larger = 1.25;  // a usual spread of sizes stays below this
  double volume = 0.0, weighted = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double own = volume_of(bed, i);
    volume += own;
    weighted += own * std::cbrt(6.0 / pi * own);
  }
  return weighted > larger * volume ? weighted / volume : 1.0;
}

/// Number of the column that holds a coordinate; wraps beyond the box.
std::size_t column_of(double coordinate, double extent, std::size_t columns) {
  const double share = coordinate / extent - std::floor(coordinate / extent);
  return std::min(static_cast<std::size_t>(share * static_cast<double>(columns)), columns - 1);
}

std::size_t columns_along(double extent, double least) {
  return static_cast<std::size_t>(std::max(1.0, std::floor(extent / least)));
}

/// Whether the middle of floor column (i, j) of a tube, `across` columns wide, stands in it.
bool is_in_tube(std::size_t i, std::size_t j, std::size_t across) {
  const double half = static_cast<double>(across) / 2.0;
  const double x = static_cast<double>(i) + 0.5 - half, y = static_cast<double>(j) + 0.5 - half;
  return x * x + y * y <= half * half;
}

/// Median over floor columns of the highest top among the grains that stand above each.
/// `top_of(i)` is the highest point of grain i.
template <class TopOf>
double median_top(const Grains& bed, double least, TopOf top_of) {
  const Box& box = bed.box;
  const std::size_t columns_x = columns_along(box.length, least),
                    columns_y = columns_along(box.width, least);
  if (columns_x > 4 * bed.grains() / columns_y) return 0.0;  // even of a tube most are empty
  std::vector<double> highest(columns_x * columns_y, 0.0);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    double& top = highest[column_of(bed.position[i].y, box.width, columns_y) * columns_x +
                          column_of(bed.position[i].x, box.length, columns_x)];
    top = std::max(top, top_of(i));
  }
  std::vector<double> tops;
  for (std::size_t k = 0; k < highest.size(); ++k) {
    const bool counts = !box.is_tube || is_in_tube(k % columns_x, k / columns_x, columns_x);
    if (counts) tops.push_back(highest[k]);
  }
  const auto middle = tops.begin() + static_cast<std::ptrdiff_t>(tops.size() / 2);
  std::nth_element(tops.begin(), middle, tops.end());
  return *middle;
}

}  // namespace

double sphere_slab_volume(double radius, double low, double high) {
  const double a = std::clamp(low, -radius, radius), b = std::clamp(high, -radius, radius);
  const double squared = radius * radius;
  return pi * (b - a) * (squared - (a * a + a * b + b * b) / 3.0);
}

Span span_of(const SphereBed& bed, std::size_t grain, int axis) {
  const Record<double>& p = bed.position[grain];
  const double centre = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  return {centre - p.w, centre + p.w};
}
Span span_of(const PolyhedronBed& bed, std::size_t grain, int axis) {
  return span_along(bed.shape(grain), bed.pose(grain), axis);
}

double volume_in(const Slab& slab, const SphereBed& bed, std::size_t grain) {
  const Record<double>& p = bed.position[grain];
  return sphere_slab_volume(p.w, slab.bottom - p.z, slab.top - p.z);
}
double volume_in(const Slab& slab, const PolyhedronBed& bed, std::size_t grain) {
  return slab_volume(bed.shape(grain), bed.pose(grain), 2, slab.bottom, slab.top);
}

template <class Kind>
double solid_fraction(const Bed<Kind>& bed, const Slab& slab) {
  double solid = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) solid += volume_in(slab, bed, i);
  return solid / (bed.box.floor_area() * slab.height());
}

template <class Kind>
double small_share(const Bed<Kind>& bed, const Slab& slab, double small_below) {
  double large = 0.0, small = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    (bed.position[i].w < small_below ? small : large) += volume_in(slab, bed, i);
  }
  return small / (large + small);  // 0 / 0 is NaN
}

template <class Kind>
double surface_height(const Bed<Kind>& bed) {
  return median_top(bed, least_column(bed), [&](std::size_t i) { return span_of(bed, i, 2).high; });
}

template double solid_fraction(const SphereBed&, const Slab&);
template double solid_fraction(const PolyhedronBed&, const Slab&);
template double small_share(const SphereBed&, const Slab&, double);
template double small_share(const PolyhedronBed&, const Slab&, double);
template double surface_height(const SphereBed&);
template double surface_height(const PolyhedronBed&);

}  // namespace grainsweep
