#include "engine/measure/contact_forces.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

constexpr double layer_height = 1.0;  // d

std::size_t layer_of(const PairForce& force, const Slab& slab) {
  return static_cast<std::size_t>((force.height - slab.bottom) / layer_height);
}

/// Mean force of each layer of the slab.
std::vector<double> layer_means(const std::vector<PairForce>& forces, const Slab& slab) {
  const auto layers = static_cast<std::size_t>(std::ceil(slab.height() / layer_height)) + 1;
  std::vector<double> sum(layers, 0.0), count(layers, 0.0);
  for (const PairForce& force : forces) {
    if (!slab.contains(force.height)) continue;
    sum[layer_of(force, slab)] += force.magnitude;
    count[layer_of(force, slab)] += 1.0;
  }
  for (std::size_t k = 0; k < layers; ++k) sum[k] /= std::max(count[k], 1.0);
  return sum;
}

}  // namespace

ForceStatistics force_statistics(const std::vector<PairForce>& forces, const Slab& slab,
                                 double bin_width, double largest) {
  const auto bins = static_cast<std::size_t>(std::llround(largest / bin_width));
  ForceStatistics statistics{0.0, 0.0, {bin_width, std::vector<double>(bins, 0.0)}};
  const std::vector<double> means = layer_means(forces, slab);
  double count = 0.0;
  for (const PairForce& force : forces) {
    if (!slab.contains(force.height)) continue;
    const double relative = force.magnitude / means[layer_of(force, slab)];
    statistics.mean += force.magnitude;
    statistics.square += relative * relative;
    count += 1.0;
    if (relative < largest)
      statistics.density.values[static_cast<std::size_t>(relative / bin_width)] += 1.0;
  }
  statistics.mean /= count;  // 0 / 0 is NaN
  statistics.square /= count;
  for (double& value : statistics.density.values) value /= count * bin_width;
  return statistics;
}

}  // namespace grainsweep
