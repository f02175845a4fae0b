// Straight line through points with known errors: y = intercept + slope x, by least squares.
//
// With w_i = 1 / error_i^2, x_m and y_m the weighted means and S_xx = sum w (x - x_m)^2:
//   slope = sum w (x - x_m)(y - y_m) / S_xx,      intercept = y_m - slope x_m,
//   var(slope) = 1 / S_xx,   var(intercept) = 1 / sum w + x_m^2 / S_xx,
//   cov(intercept, slope) = -x_m / S_xx
// (Bevington & Robinson, Data Reduction and Error Analysis, ch. 6).
//
// Points that miss the line by more than their errors scatter about it, each by as much as the
// others: a scatter s, the square of which adds to that of every error, such that chi2 becomes the
// number of degrees of freedom (R. C. Paule & J. Mandel, J. Res. Natl. Bur. Stand. 87, 377, 1982).
// Where all errors are the same, this is the plain line, with errors widened by the root of chi2
// per degree of freedom. Where they differ, the line does not go through the few points of
// smallest error alone.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace grainsweep {

/// One measured value. x and y carry the caller's units; `error` has the unit of y.
struct LinePoint {
  double x = 0.0;
  double y = 0.0;
  double error = 0.0;  ///< standard error of y
};

/// Units: intercept that of y, slope y / x, and their errors alike.
struct LineFit {
  double intercept = 0.0;
  double slope = 0.0;
  double intercept_error = 0.0;  ///< one standard error
  double slope_error = 0.0;      ///< one standard error
  double covariance = 0.0;       ///< of intercept and slope
  double chi2 = 0.0;             ///< sum of w (y - line)^2; of the line without scatter
  double scatter = 0.0;          ///< of the points, beyond their errors, in the unit of y
  int degrees_of_freedom = 0;    ///< number of points - 2
  double r_squared = 0.0;        ///< share of the weighted variance explained; NaN if y is constant
};

/// By how much values miss what is said of them all: a line through them, or one value.
struct Misfit {
  double chi2_per_dof = 0.0;
  int degrees_of_freedom = 0;
  /// Degrees of freedom from which the least known of their errors is known, which are widened by
  /// Student's distribution for it; infinite where errors are known as they are.
  double errors_known_from = std::numeric_limits<double>::infinity();
};

/// Whether that may be chance: where it holds, a larger chi2 comes up once in 200 times (F test).
/// Per degree of freedom that is 7.9 for one, 5.3 for two, 2.9 for seven if errors are known as
/// they are; 12, 9.3 and 6.9 if they are known from 6 degrees of freedom.
bool may_hold(const Misfit& misfit);

/// A width of a container, and whether no line over one over the width need hold there.
struct LineWidth {
  double width = 0.0;  ///< d
  bool is_narrow = false;
};

/// A line needs that many different widths.
inline constexpr std::size_t least_widths_of_line = 3;

/// Which of these a line is fitted to: narrow ones only where too few others are left.
std::vector<bool> widths_on_line(const std::vector<LineWidth>& widths);

/// Nothing if the points do not determine a line with errors: fewer than three points, fewer than
/// two different x, or an error that is not positive and finite.
std::optional<LineFit> fit_line(const std::vector<LinePoint>& points);

/// The same for points that may also scatter about the line.
std::optional<LineFit> fit_scattered_line(const std::vector<LinePoint>& points);

}  // namespace grainsweep
