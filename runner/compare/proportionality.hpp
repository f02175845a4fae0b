// A straight line through zero: is y proportional to x, when both have errors?
//
// Least squares with the weight of each point 1 / (y_error^2 + slope^2 x_error^2), repeated until
// the slope stays (effective variance; Orear 1982).
#pragma once

#include <vector>

namespace grainsweep {

/// One standard error each; the errors must be positive.
struct ErrorPoint {
  double x = 0.0, x_error = 0.0;
  double y = 0.0, y_error = 0.0;
};

struct Proportionality {
  double slope = 0.0;
  double error = 0.0;         ///< one standard error, from the errors of the points
  double chi2_per_dof = 0.0;  ///< degrees of freedom: points - 1
};

/// Requires two points or more, not all with x = 0.
Proportionality fit_proportionality(const std::vector<ErrorPoint>& points);

}  // namespace grainsweep
