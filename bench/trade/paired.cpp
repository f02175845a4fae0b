#include "bench/trade/paired.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "runner/tables/csv.hpp"
#include "runner/tables/groups.hpp"

namespace grainsweep::bench {

namespace {

/// As many starts as there are tell it by themselves: not widened as the error of a few is.
double standard_error(const Spread& spread) { return spread.sd / std::sqrt(spread.n); }

}  // namespace

MeanError mean_error(const ByStart& values) {
  std::vector<double> all;
  for (const auto& [start, value] : values) all.push_back(value);
  const Spread spread = spread_of(all);
  return {spread.mean, standard_error(spread), spread.n};
}

double mean(const ByStart& values) { return mean_error(values).mean; }

MeanError difference_of_means(const MeanError& changed, const MeanError& reference) {
  return {changed.mean - reference.mean, std::hypot(changed.error, reference.error), changed.n};
}

MeanError paired_difference(const ByStart& changed, const ByStart& reference) {
  std::vector<double> differences;
  for (const auto& [start, value] : changed) {
    const auto other = reference.find(start);
    if (other != reference.end()) differences.push_back(value - other->second);
  }
  const Spread spread = spread_of(differences);
  return {spread.mean, standard_error(spread), spread.n};
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
  const Spread spread = spread_of(without);
  const bool is_whole = static_cast<std::size_t>(spread.n) == without.size();
  const double times_standard_error = spread.n - 1.0;
  return {estimate(starts), is_whole ? times_standard_error * standard_error(spread) : no_number,
          static_cast<int>(starts.size())};
}

}  // namespace grainsweep::bench
