#include "runner/analysis/fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/tools/roots.hpp>

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

/// The same points, each of which scatters by so much more.
std::vector<LinePoint> with_scatter(std::vector<LinePoint> points, double variance) {
  for (LinePoint& point : points) point.error = std::sqrt(point.error * point.error + variance);
  return points;
}

/// The variance with which chi2 is the number of degrees of freedom; that without is larger. chi2
/// falls as it grows, and is no larger than the squares about the unweighted line over it.
double variance_of_scatter(const std::vector<LinePoint>& points) {
  std::vector<LinePoint> alike = points;
  for (LinePoint& point : alike) point.error = 1.0;
  const LineFit unweighted = fit_line(alike).value();
  const double degrees = unweighted.degrees_of_freedom, most = unweighted.chi2 / degrees;
  const auto too_much = [&](double variance) {
    return fit_line(with_scatter(points, variance)).value().chi2 - degrees;
  };
  if (!(too_much(most) < 0.0)) return most;
  constexpr int bits = 40;
  std::uintmax_t most_steps = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      too_much, 0.0, most, boost::math::tools::eps_tolerance<double>(bits), most_steps);
  return (below + above) / 2.0;
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

std::optional<LineFit> fit_scattered_line(const std::vector<LinePoint>& points) {
  const auto plain = fit_line(points);
  if (!plain || plain->chi2 <= plain->degrees_of_freedom) return plain;
  const double variance = variance_of_scatter(points);
  LineFit fit = fit_line(with_scatter(points, variance)).value();
  fit.chi2 = plain->chi2;
  fit.scatter = std::sqrt(variance);
  return fit;
}

std::vector<bool> widths_on_line(const std::vector<LineWidth>& widths) {
  std::set<double> wide;
  for (const LineWidth& one : widths) {
    if (!one.is_narrow) wide.insert(one.width);
  }
  const bool takes_narrow = wide.size() < least_widths_of_line;
  std::vector<bool> are_on_line;
  are_on_line.reserve(widths.size());
  for (const LineWidth& one : widths) are_on_line.push_back(takes_narrow || !one.is_narrow);
  return are_on_line;
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
