#include "runner/analysis/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>

#include "runner/analysis/student.hpp"

namespace grainsweep {
namespace {

double weight_of(const LinePoint& point) { return 1.0 / (point.error * point.error); }

bool determines_a_line(const std::vector<LinePoint>& points) {
  const auto weighable = [&](const LinePoint& point) {
    const double weight = weight_of(point);
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(weight) && weight > 0;
  };
  const auto elsewhere = [&](const LinePoint& point) { return point.x != points.front().x; };
  return points.size() >= 3 && std::all_of(points.begin(), points.end(), weighable) &&
         std::any_of(points.begin(), points.end(), elsewhere);
}

/// Weighted means, and the sums of squares about them.
struct Moments {
  double weight = 0.0, x_mean = 0.0, y_mean = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
};

Moments moments_of(const std::vector<LinePoint>& points) {
  Moments sum;
  for (const LinePoint& point : points) {
    const double weight = weight_of(point);
    sum.weight += weight;
    sum.x_mean += weight * point.x;
    sum.y_mean += weight * point.y;
  }
  sum.x_mean /= sum.weight;
  sum.y_mean /= sum.weight;
  for (const LinePoint& point : points) {
    const double weight = weight_of(point);
    const double dx = point.x - sum.x_mean;
    const double dy = point.y - sum.y_mean;
    sum.xx += weight * dx * dx;
    sum.xy += weight * dx * dy;
    sum.yy += weight * dy * dy;
  }
  return sum;
}

double chi2_of(const std::vector<LinePoint>& points, const LineFit& fit) {
  double chi2 = 0.0;
  for (const LinePoint& point : points) {
    const double residual = point.y - fit.intercept - fit.slope * point.x;
    chi2 += weight_of(point) * residual * residual;
  }
  return chi2;
}

}  // namespace

std::optional<LineFit> fit_line(const std::vector<LinePoint>& points) {
  if (!determines_a_line(points)) return std::nullopt;
  const Moments sum = moments_of(points);
  LineFit fit;
  fit.slope = sum.xy / sum.xx;
  fit.intercept = sum.y_mean - fit.slope * sum.x_mean;
  fit.chi2 = chi2_of(points, fit);
  fit.degrees_of_freedom = static_cast<int>(points.size()) - 2;
  fit.slope_error = std::sqrt(1.0 / sum.xx);
  fit.intercept_error = std::sqrt(1.0 / sum.weight + sum.x_mean * sum.x_mean / sum.xx);
  fit.covariance = -sum.x_mean / sum.xx;
  fit.r_squared = sum.yy > 0 ? 1.0 - fit.chi2 / sum.yy : std::numeric_limits<double>::quiet_NaN();
  return fit;
}

bool may_hold(const Misfit& misfit) {
  constexpr double seldom = 1.0 / 200.0;
  const double many = misfit.degrees_of_freedom, known = misfit.errors_known_from;
  if (std::isinf(known)) {
    const boost::math::chi_squared chance(many);
    return misfit.chi2_per_dof * many <=
           boost::math::quantile(boost::math::complement(chance, seldom));
  }
  const double widening = student_quantile(known) / normal_quantile;
  const boost::math::fisher_f chance(many, known);
  return misfit.chi2_per_dof * widening * widening <=
         boost::math::quantile(boost::math::complement(chance, seldom));
}

}  // namespace grainsweep
