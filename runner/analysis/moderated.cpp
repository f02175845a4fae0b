#include "runner/analysis/moderated.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/polygamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>

namespace grainsweep {
namespace {

/// Levels of the tests that a group is like the others, and that all are as much alike as usual.
constexpr double unlike_level = 0.001, less_alike_level = 0.01;

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
    return std::min(below, 1.0 - below) >= unlike_level / 2.0;
  });
  return are_alike;
}

/// Bartlett's test: whether variances are so different that one for all is out of the question.
bool differ(const std::vector<KnownVariance>& some, const KnownVariance& pooled) {
  double sum = pooled.degrees_of_freedom * std::log(pooled.variance), inverses = 0.0;
  for (const KnownVariance& one : some) {
    sum -= one.degrees_of_freedom * std::log(one.variance);
    inverses += 1.0 / one.degrees_of_freedom;
  }
  const double others = static_cast<double>(some.size()) - 1.0;
  const double correction = 1.0 + (inverses - 1.0 / pooled.degrees_of_freedom) / (3.0 * others);
  const boost::math::chi_squared distribution(others);
  return boost::math::cdf(boost::math::complement(distribution, std::max(0.0, sum / correction))) <
         less_alike_level;
}

/// The x whose trigamma function is `value`, which is positive: Newton's steps for its inverse,
/// which is nearly straight.
double inverse_trigamma(double value) {
  constexpr int most_steps = 50;
  double x = 0.5 + 1.0 / value;
  for (int step = 0; step < most_steps; ++step) {
    const double here = boost::math::trigamma(x);
    const double change = here * (1.0 - here / value) / boost::math::polygamma(2, x);
    x += change;
    if (std::abs(change) < 1e-8 * x) break;
  }
  return x;
}

/// What groups say of one another: their common variance, known from D degrees of freedom, and k.
struct Common {
  KnownVariance variance;
  double likeness = usual_likeness;
};

Common common_of(const std::vector<KnownVariance>& some) {
  Common common;
  double squares = 0.0, logs = 0.0, scatter_of_few = 0.0;
  for (const KnownVariance& one : some) {
    squares += one.degrees_of_freedom * one.variance;
    common.variance.degrees_of_freedom += one.degrees_of_freedom;
    logs += log_of(one) / static_cast<double>(some.size());
    scatter_of_few +=
        boost::math::trigamma(one.degrees_of_freedom / 2.0) / static_cast<double>(some.size());
  }
  common.variance.variance = squares / common.variance.degrees_of_freedom;
  if (some.size() < 2 || !differ(some, common.variance)) return common;
  double scatter = 0.0;
  for (const KnownVariance& one : some) {
    scatter += std::pow(log_of(one) - logs, 2) / (static_cast<double>(some.size()) - 1.0);
  }
  const double of_truth = scatter - scatter_of_few;
  if (of_truth <= boost::math::trigamma(usual_likeness / 2.0)) return common;
  const double half = inverse_trigamma(of_truth);
  common.likeness = 2.0 * half;
  common.variance.variance = std::exp(logs + boost::math::digamma(half) - std::log(half));
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
