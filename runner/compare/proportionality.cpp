#include "runner/compare/proportionality.hpp"

#include <cmath>

namespace grainsweep {
namespace {

constexpr int rounds = 50;  // the weights settle within ten, if at all

double weight_of(const ErrorPoint& point, double slope) {
  return 1.0 / (point.y_error * point.y_error + slope * slope * point.x_error * point.x_error);
}

}  // namespace

Proportionality fit_proportionality(const std::vector<ErrorPoint>& points) {
  Proportionality fit;
  double squares = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double products = 0.0;
    squares = 0.0;
    for (const ErrorPoint& point : points) {
      const double weight = weight_of(point, fit.slope);
      products += weight * point.x * point.y;
      squares += weight * point.x * point.x;
    }
    fit.slope = products / squares;
  }
  fit.error = std::sqrt(1.0 / squares);
  for (const ErrorPoint& point : points) {
    const double miss = point.y - fit.slope * point.x;
    fit.chi2_per_dof += weight_of(point, fit.slope) * miss * miss;
  }
  fit.chi2_per_dof /= static_cast<double>(points.size() - 1);
  return fit;
}

}  // namespace grainsweep
