#include "engine/measure/pair_correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Edge of the region along one axis.
struct Edge {
  double length;
  bool is_periodic;
};

/// The centres in the slab, by height, and their region.
struct Region {
  std::vector<Record<double>> centres;
  std::array<Edge, 3> edges{};
};

double spread_of(const std::vector<Record<double>>& centres, double Record<double>::*axis) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Record<double>& p : centres) {
    low = std::min(low, p.*axis);
    high = std::max(high, p.*axis);
  }
  return high - low;
}

Region region_of(const SphereBed& bed, const Slab& slab) {
  Region region;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    if (slab.bottom <= p.z && p.z < slab.top) region.centres.push_back(p);
  }
  std::stable_sort(region.centres.begin(), region.centres.end(),
                   [](const Record<double>& a, const Record<double>& b) { return a.z < b.z; });
  const double x = bed.box.period_x(), y = bed.box.period_y();
  region.edges = {Edge{x > 0.0 ? x : spread_of(region.centres, &Record<double>::x), x > 0.0},
                  Edge{y > 0.0 ? y : spread_of(region.centres, &Record<double>::y), y > 0.0},
                  Edge{slab.height(), false}};
  return region;
}

double reach_of(const Region& region) {
  double reach = std::numeric_limits<double>::max();
  for (const Edge& edge : region.edges) {
    reach = std::min(reach, edge.is_periodic ? edge.length / 2.0 : edge.length);
  }
  return reach;
}

/// Coefficients of 1, r, r^2, r^3 of the direction mean of the product of (E_i - r |u_i|).
std::array<double, 4> covariance_of(const std::array<Edge, 3>& edges) {
  constexpr std::array<double, 4> mean = {1.0, -1.0 / 2.0, 2.0 / (3.0 * pi), -1.0 / (4.0 * pi)};
  std::array<double, 4> sums = {1.0, 0.0, 0.0, 0.0};  // elementary symmetric in 1 and E
  for (const Edge& edge : edges) {
    for (std::size_t k = 4; k-- > 0;) {
      const double shorter = !edge.is_periodic && k > 0 ? sums[k - 1] : 0.0;
      sums[k] = sums[k] * edge.length + shorter;
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

double nearest(double difference, const Edge& edge) {
  return edge.is_periodic ? difference - edge.length * std::nearbyint(difference / edge.length)
                          : difference;
}

/// Pairs by distance; centres are sorted by height, so that few are looked at in vain.
std::vector<double> count_pairs(const Region& region, double bin_width, std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  const double reach = bin_width * static_cast<double>(bins);
  for (auto a = region.centres.begin(); a != region.centres.end(); ++a) {
    for (auto b = a + 1; b != region.centres.end() && b->z - a->z < reach; ++b) {
      const double x = nearest(b->x - a->x, region.edges[0]);
      const double y = nearest(b->y - a->y, region.edges[1]), z = b->z - a->z;
      const double squared = x * x + y * y + z * z;
      if (squared >= reach * reach) continue;
      const auto bin = static_cast<std::size_t>(std::sqrt(squared) / bin_width);
      counts[std::min(bin, bins - 1)] += 1.0;
    }
  }
  return counts;
}

}  // namespace

Curve pair_correlation(const SphereBed& bed, const Slab& slab, double bin_width, double largest) {
  const Region region = region_of(bed, slab);
  if (region.centres.size() < 2) return {bin_width, {}};
  const double reach = std::min(largest, reach_of(region));
  const auto bins = static_cast<std::size_t>(std::max(0.0, reach / bin_width + 1e-9));
  Curve curve{bin_width, count_pairs(region, bin_width, bins)};
  const std::array<double, 4> covariance = covariance_of(region.edges);
  const auto n = static_cast<double>(region.centres.size());
  const double volume = region.edges[0].length * region.edges[1].length * region.edges[2].length;
  const double pairs = n * (n - 1.0) / 2.0 / (volume * volume);
  for (std::size_t k = 0; k < bins; ++k) {
    const double low = static_cast<double>(k) * bin_width;
    curve.values[k] /= pairs * (covered(covariance, low + bin_width) - covered(covariance, low));
  }
  return curve;
}

}  // namespace grainsweep
