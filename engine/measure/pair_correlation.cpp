#include "engine/measure/pair_correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <boost/math/quadrature/gauss.hpp>

#include "engine/measure/cut_tube.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Extent of the region along one axis.
struct Extent {
  double length;
  bool is_periodic;

  double period() const { return is_periodic ? length : 0.0; }
};

/// The centres in the slab, by height, and their region.
struct Region {
  std::vector<Record<double>> centres;
  std::array<Extent, 3> sides{};
  double disc_radius = 0.0;  ///< in a tube: how far from the axis centres reach, d

  double volume() const {
    const double floor =
        disc_radius > 0.0 ? pi * disc_radius * disc_radius : sides[0].length * sides[1].length;
    return floor * sides[2].length;
  }
};

double spread_of(const std::vector<Record<double>>& centres, double Record<double>::*axis) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Record<double>& p : centres) {
    low = std::min(low, p.*axis);
    high = std::max(high, p.*axis);
  }
  return high - low;
}

Region region_of(const Grains& bed, const Slab& slab) {
  Region region;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    if (slab.contains(p.z)) region.centres.push_back(p);
  }
  std::stable_sort(region.centres.begin(), region.centres.end(),
                   [](const Record<double>& a, const Record<double>& b) { return a.z < b.z; });
  const double x = bed.box.period_x(), y = bed.box.period_y();
  region.sides = {Extent{x > 0.0 ? x : spread_of(region.centres, &Record<double>::x), x > 0.0},
                  Extent{y > 0.0 ? y : spread_of(region.centres, &Record<double>::y), y > 0.0},
                  Extent{slab.height(), false}};
  for (const Record<double>& p : region.centres) {
    const double from_axis = std::hypot(p.x - bed.box.length / 2.0, p.y - bed.box.width / 2.0);
    if (bed.box.is_tube) region.disc_radius = std::max(region.disc_radius, from_axis);
  }
  return region;
}

double reach_of(const Region& region) {
  if (region.disc_radius > 0.0) return region.sides[2].length;
  double reach = std::numeric_limits<double>::max();
  for (const Extent& side : region.sides) {
    reach = std::min(reach, side.is_periodic ? side.length / 2.0 : side.length);
  }
  return reach;
}

/// Coefficients of 1, r, r^2, r^3 of the direction mean of the product of (E_i - r |u_i|).
std::array<double, 4> covariance_of(const std::array<Extent, 3>& sides) {
  constexpr std::array<double, 4> mean = {1.0, -1.0 / 2.0, 2.0 / (3.0 * pi), -1.0 / (4.0 * pi)};
  std::array<double, 4> sums = {1.0, 0.0, 0.0, 0.0};  // elementary symmetric in 1 and E
  for (const Extent& side : sides) {
    for (std::size_t k = 4; k-- > 0;) {
      const double shorter = !side.is_periodic && k > 0 ? sums[k - 1] : 0.0;
      sums[k] = sums[k] * side.length + shorter;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) sums[k] *= mean[k];
  return sums;
}

/// Integral of the covariance over the ball of radius r.
double covered(const std::array<double, 4>& covariance, double r) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto power = static_cast<double>(k + 3);
    sum += covariance[k] * 4.0 * pi * std::pow(r, power) / power;
  }
  return sum;
}

/// Integral of the set covariance of a cylinder over the vectors of lengths from `low` to `high`:
/// the part of its disc that a shift leaves in common times the height that it leaves.
double covered_in_tube(const Region& region, double low, double high) {
  using boost::math::quadrature::gauss;
  const double radius = region.disc_radius, height = region.sides[2].length;
  const auto on_sphere = [&](double r) {
    const auto of_direction = [&](double tilt) {  // from the axis
      return std::sin(tilt) * shared_area(radius, radius, r * std::sin(tilt)) *
             std::max(0.0, height - r * std::cos(tilt));
    };
    const double last = std::asin(std::min(1.0, 2.0 * radius / r));  // the discs part
    return 4.0 * pi * r * r * gauss<double, 20>::integrate(of_direction, 0.0, last);
  };
  return gauss<double, 7>::integrate(on_sphere, low, high);
}

/// The same of the region, whatever its form.
double covered(const Region& region, const std::array<double, 4>& covariance, double low,
               double high) {
  if (region.disc_radius > 0.0) return covered_in_tube(region, low, high);
  return covered(covariance, high) - covered(covariance, low);
}

/// Upright columns of the region, at least `reach` wide, so that only adjacent ones hold pairs;
/// each with its centres by height.
struct Columns {
  std::array<std::size_t, 2> count{};
  std::vector<std::vector<Record<double>>> centres;
};

/// Columns along an axis: one where three would not fit, so that no column is its neighbour twice.
std::size_t columns_across(double length, double reach) {
  const double most = std::min(std::floor(length / reach), 256.0);
  return most >= 3.0 ? static_cast<std::size_t>(most) : 1;
}

/// Column of coordinate `x`, which begins at `low` or is periodic.
std::size_t column_of(double x, double low, const Extent& side, std::size_t count) {
  if (count == 1) return 0;  // of no length, too
  const double turns = (x - low) / side.length;
  const double place = side.is_periodic ? turns - std::floor(turns) : turns;
  return std::min(count - 1, static_cast<std::size_t>(place * static_cast<double>(count)));
}

Columns columns_of(const Region& region, double reach) {
  Columns columns;
  const Extent &x = region.sides[0], &y = region.sides[1];
  columns.count = {columns_across(x.length, reach), columns_across(y.length, reach)};
  columns.centres.resize(columns.count[0] * columns.count[1]);
  const double low_x = std::ranges::min(region.centres, {}, &Record<double>::x).x;
  const double low_y = std::ranges::min(region.centres, {}, &Record<double>::y).y;
  for (const Record<double>& p : region.centres) {
    const std::size_t i = column_of(p.x, low_x, x, columns.count[0]);
    const std::size_t j = column_of(p.y, low_y, y, columns.count[1]);
    columns.centres[j * columns.count[0] + i].push_back(p);
  }
  return columns;
}

/// Places adjacent to `at` along an axis and `at` itself, each once.
std::vector<std::size_t> places_around(std::size_t at, std::size_t count, bool is_periodic) {
  std::vector<std::size_t> places = {at};
  if (count == 1) return places;
  if (at > 0 || is_periodic) places.push_back((at + count - 1) % count);
  if (at + 1 < count || is_periodic) places.push_back((at + 1) % count);
  return places;
}

/// Counts pairs by distance.
class PairCounter {
 public:
  PairCounter(const Region& region, double bin_width, std::size_t bins)
      : periods_{region.sides[0].period(), region.sides[1].period()},
        bin_width_(bin_width),
        counts_(bins, 0.0) {}

  double reach() const { return bin_width_ * static_cast<double>(counts_.size()); }
  std::vector<double> take_counts() { return std::move(counts_); }

  /// Each pair of one column once, or each of two columns. Heights say where to stop looking.
  void count(const std::vector<Record<double>>& from, const std::vector<Record<double>>& to) {
    std::size_t low = 0;
    for (std::size_t a = 0; a < from.size(); ++a) {
      while (low < to.size() && to[low].z <= from[a].z - reach()) ++low;
      for (std::size_t b = &from == &to ? a + 1 : low;
           b < to.size() && to[b].z - from[a].z < reach(); ++b) {
        add(from[a], to[b]);
      }
    }
  }

 private:
  void add(const Record<double>& a, const Record<double>& b) {
    const double x = nearest_image(b.x - a.x, periods_[0]);
    const double y = nearest_image(b.y - a.y, periods_[1]);
    const double z = b.z - a.z, squared = x * x + y * y + z * z;
    if (squared >= reach() * reach()) return;
    const auto bin = static_cast<std::size_t>(std::sqrt(squared) / bin_width_);
    counts_[std::min(bin, counts_.size() - 1)] += 1.0;
  }

  std::array<double, 2> periods_;
  double bin_width_;
  std::vector<double> counts_;
};

std::vector<double> count_pairs(const Region& region, double bin_width, std::size_t bins) {
  if (bins == 0) return {};
  PairCounter counter(region, bin_width, bins);
  const Columns columns = columns_of(region, counter.reach());
  const auto [across, along] = columns.count;
  for (std::size_t at = 0; at < columns.centres.size(); ++at) {
    for (const std::size_t j : places_around(at / across, along, region.sides[1].is_periodic)) {
      for (const std::size_t i : places_around(at % across, across, region.sides[0].is_periodic)) {
        const std::size_t other = j * across + i;
        if (other >= at) counter.count(columns.centres[at], columns.centres[other]);
      }
    }
  }
  return counter.take_counts();
}

}  // namespace

Curve pair_correlation(const Grains& bed, const Slab& slab, double bin_width, double largest) {
  const Region region = region_of(bed, slab);
  if (region.centres.size() < 2) return {bin_width, {}};
  const double reach = std::min(largest, reach_of(region));
  const auto bins = static_cast<std::size_t>(std::max(0.0, reach / bin_width + 1e-9));
  Curve curve{bin_width, count_pairs(region, bin_width, bins)};
  const std::array<double, 4> covariance = covariance_of(region.sides);
  const auto n = static_cast<double>(region.centres.size());
  const double pairs = n * (n - 1.0) / 2.0 / (region.volume() * region.volume());
  for (std::size_t k = 0; k < bins; ++k) {
    const double low = static_cast<double>(k) * bin_width;
    curve.values[k] /= pairs * covered(region, covariance, low, low + bin_width);
  }
  return curve;
}

}  // namespace grainsweep
