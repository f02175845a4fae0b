#include "runner/analysis/moderated.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/digamma.hpp>

namespace grainsweep {
namespace {

/// How rarely a group that is like the others is taken for one that scatters far more, and far
/// less. What three packings happen to agree in is known too well for ever: that must be rarer.
constexpr double far_more_level = 5e-4, far_less_level = 1e-5;

/// By how much another likeness must make the variances more likely than the usual one, in
/// logarithms: what chance alone reaches once in a hundred times.
constexpr double telling_log_likelihood = 2.7;

bool tells(const KnownVariance& one) { return one.degrees_of_freedom > 0.0 && one.variance > 0.0; }

/// The logarithm of a variance, without its bias.
double log_of(const KnownVariance& one) {
  const double half = one.degrees_of_freedom / 2.0;
  return std::log(one.variance) - boost::math::digamma(half) + std::log(half);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2.0;
}

/// Of each group: whether it tells a variance that is not unlike that of most others.
std::vector<bool> alike(const std::vector<KnownVariance>& own) {
  std::vector<double> logs;
  for (const KnownVariance& one : own) {
    if (tells(one)) logs.push_back(log_of(one));
  }
  std::vector<bool> are_alike(own.size());
  if (logs.empty()) return are_alike;
  const double typical = std::exp(median(std::move(logs)));
  std::transform(own.begin(), own.end(), are_alike.begin(), [&](const KnownVariance& one) {
    if (!tells(one)) return false;
    const boost::math::fisher_f ratio(one.degrees_of_freedom, usual_likeness);
    const double below = boost::math::cdf(ratio, one.variance / typical);
    return below >= far_less_level && 1.0 - below >= far_more_level;
  });
  return are_alike;
}

/// Logarithm of how likely the variances are, but for what depends on them alone, if those of
/// groups scatter about `common` with this likeness: s^2 / s0^2 then has an F distribution.
double log_likelihood(const std::vector<KnownVariance>& some, double common, double likeness) {
  double sum = 0.0;
  for (const KnownVariance& one : some) {
    const double d = one.degrees_of_freedom, ratio = d * one.variance / (likeness * common);
    sum += d / 2.0 * std::log(ratio) - (d + likeness) / 2.0 * std::log1p(ratio) -
           std::log(boost::math::beta(d / 2.0, likeness / 2.0));
  }
  return sum;
}

/// The s0^2 that makes the variances most likely: at it that likelihood's slope over log s0^2,
/// which falls with s0^2, is 0. It lies between the least and the greatest of them.
double most_likely(const std::vector<KnownVariance>& some, double likeness) {
  const auto slope = [&](double common) {
    double sum = 0.0;
    for (const KnownVariance& one : some) {
      const double d = one.degrees_of_freedom, ratio = d * one.variance / (likeness * common);
      sum += (d + likeness) * ratio / (1.0 + ratio) - d;
    }
    return sum;
  };
  const auto by_variance = [](const KnownVariance& a, const KnownVariance& b) {
    return a.variance < b.variance;
  };
  const auto [least, greatest] = std::minmax_element(some.begin(), some.end(), by_variance);
  double low = std::log(least->variance), high = std::log(greatest->variance);
  constexpr double close_enough = 1e-6;
  while (high - low > close_enough) {
    const double middle = (low + high) / 2.0;
    (slope(std::exp(middle)) > 0.0 ? low : high) = middle;
  }
  return std::exp((low + high) / 2.0);
}

/// What groups say of one another: their common variance, known from D degrees of freedom, and k.
struct Common {
  KnownVariance variance;
  double likeness = usual_likeness;
};

Common common_of(const std::vector<KnownVariance>& some) {
  Common common;
  double squares = 0.0;
  for (const KnownVariance& one : some) {
    squares += one.degrees_of_freedom * one.variance;
    common.variance.degrees_of_freedom += one.degrees_of_freedom;
  }
  common.variance.variance = squares / common.variance.degrees_of_freedom;
  if (some.size() < 2) return common;
  double best = log_likelihood(some, most_likely(some, usual_likeness), usual_likeness) +
                telling_log_likelihood;
  for (const double likeness : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    const double variance = most_likely(some, likeness);
    const double here = log_likelihood(some, variance, likeness);
    if (here <= best) continue;
    best = here;
    common.variance.variance = variance;
    common.likeness = likeness;
  }
  return common;
}

}  // namespace

std::vector<KnownVariance> moderated(const std::vector<KnownVariance>& own) {
  const std::vector<bool> are_alike = alike(own);
  std::vector<KnownVariance> some;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (are_alike[i]) some.push_back(own[i]);
  }
  std::vector<KnownVariance> all = own;
  if (some.empty()) return all;
  const auto [common, k] = common_of(some);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (tells(own[i]) && !are_alike[i]) continue;
    const double d = are_alike[i] ? own[i].degrees_of_freedom : 0.0;
    all[i] = {(k * common.variance + d * own[i].variance) / (k + d),
              std::min(k + d, common.degrees_of_freedom)};
  }
  return all;
}

}  // namespace grainsweep
