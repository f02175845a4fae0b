#include "bench/trade/paired.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runner/tables/csv.hpp"

namespace grainsweep::bench {
namespace {

double mean_of(const std::vector<double>& values) {
  return values.empty() ? no_number
                        : std::accumulate(values.begin(), values.end(), 0.0) /
                              static_cast<double>(values.size());
}

double squares_about(double centre, const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, double value) {
    return sum + (value - centre) * (value - centre);
  });
}

}  // namespace

double mean(const ByStart& values) {
  double sum = 0.0;
  for (const auto& [start, value] : values) sum += value;
  return sum / static_cast<double>(values.size());
}

MeanError paired_difference(const ByStart& changed, const ByStart& reference) {
  std::vector<double> differences;
  for (const auto& [start, value] : changed) {
    const auto other = reference.find(start);
    if (other != reference.end()) differences.push_back(value - other->second);
  }
  const double centre = mean_of(differences), n = static_cast<double>(differences.size());
  const double error =
      n < 2.0 ? no_number : std::sqrt(squares_about(centre, differences) / (n - 1.0) / n);
  return {centre, error, static_cast<int>(differences.size())};
}

double median(std::vector<double> values) {
  if (values.empty()) return no_number;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

MeanError jackknife(const std::vector<int>& starts, int groups,
                    const std::function<double(const std::vector<int>&)>& estimate) {
  std::vector<double> without;
  for (int group = 0; group < groups; ++group) {
    std::vector<int> kept;
    std::copy_if(starts.begin(), starts.end(), std::back_inserter(kept),
                 [&](int start) { return start % groups != group; });
    if (kept.size() < starts.size()) without.push_back(estimate(kept));
  }
  const double g = static_cast<double>(without.size());
  const double error =
      g < 2.0 ? no_number : std::sqrt((g - 1.0) / g * squares_about(mean_of(without), without));
  return {estimate(starts), error, static_cast<int>(starts.size())};
}

}  // namespace grainsweep::bench
