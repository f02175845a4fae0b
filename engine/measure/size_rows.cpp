#include "engine/measure/size_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr int formula_rows = 25;

/// The diameters at which shares are given.
std::vector<double> diameters_of(const SizeCurve& curve) {
  std::vector<double> diameters = curve.diameters;
  diameters.erase(std::unique(diameters.begin(), diameters.end()), diameters.end());
  if (curve.is_table || diameters.size() == 1) return diameters;
  const double smallest = diameters.front(), ratio = diameters.back() / smallest;
  std::vector<double> spaced;
  spaced.reserve(formula_rows);
  for (int k = 0; k < formula_rows; ++k) {
    spaced.push_back(smallest * std::pow(ratio, static_cast<double>(k) / (formula_rows - 1)));
  }
  return spaced;
}

/// Weight of the grains up to each diameter, over that of all. `diameters` are sorted.
std::vector<double> shares_of(const Grains& bed, const std::vector<double>& diameters,
                              SizeWeight by, const Slab& slab,
                              std::span<const double> unit_weights) {
  constexpr double rounding = 1e-12;  // of what a diameter goes through from its drawing on
  std::vector<double> up_to(diameters.size() + 1, 0.0);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& grain = bed.position[i];
    if (!slab.contains(grain.z)) continue;
    const double diameter = 2.0 * grain.w;
    const auto row = std::lower_bound(diameters.begin(), diameters.end(), diameter - rounding);
    up_to[static_cast<std::size_t>(row - diameters.begin())] +=
        unit_weights[i] * weight_of(by, diameter);
  }
  for (std::size_t k = 1; k < up_to.size(); ++k) up_to[k] += up_to[k - 1];
  const double all = up_to.back();
  for (double& share : up_to) share /= all;
  return up_to;
}

}  // namespace

std::vector<SizeRow> size_rows(const Grains& bed, const SizeCurve& curve, const Slab& slab,
                               std::span<const double> unit_weights) {
  const std::vector<double> diameters = diameters_of(curve);
  const auto packed = shares_of(bed, diameters, curve.by, {-infinity, infinity}, unit_weights);
  const auto in_slab = shares_of(bed, diameters, curve.by, slab, unit_weights);
  std::vector<SizeRow> rows;
  for (std::size_t k = 0; k < diameters.size(); ++k) {
    rows.push_back({diameters[k], passing_at(curve, diameters[k]), packed[k], in_slab[k]});
  }
  return rows;
}

}  // namespace grainsweep
