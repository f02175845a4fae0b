// What a setting does to a mean, from the same starts settled in two ways.
#pragma once

#include <functional>
#include <map>
#include <vector>

namespace grainsweep::bench {

/// NaN where there are too few values.
struct MeanError {
  double mean = 0.0;
  double error = 0.0;  ///< standard error of the mean
  int n = 0;
};

/// A value of each start, by the number of the start.
using ByStart = std::map<int, double>;

/// NaN of none.
double mean(const ByStart& values);
MeanError mean_error(const ByStart& values);

/// Mean of one ensemble of beds less that of another, which has no start of it.
MeanError difference_of_means(const MeanError& changed, const MeanError& reference);

/// Mean of `changed` less `reference` over the starts that both have: what differs from start to
/// start falls out.
MeanError paired_difference(const ByStart& changed, const ByStart& reference);

/// Of an even number of values the mean of the middle two; NaN of none.
double median(std::vector<double> values);

/// `estimate` of all starts and its error by the jackknife, with a group of starts left out at a
/// time: error^2 = (g - 1) / g sum (estimate_k - mean)^2 over g groups, of which start s is in the
/// one with number s modulo g; NaN if there is no estimate without one of them. For what is no mean
/// over starts.
MeanError jackknife(const std::vector<int>& starts, int groups,
                    const std::function<double(const std::vector<int>&)>& estimate);

}  // namespace grainsweep::bench
