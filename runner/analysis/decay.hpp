// How far a wall reaches into a packing: the damped oscillation of the solid fraction beside it.
//
//   phi(y) = bulk + amplitude exp(-y / length) cos(2 pi y / period + phase),   y from the wall
//
// least squares with equal weights over a fixed window, from the best point of a coarse grid of
// lengths and periods. The other three follow linearly from these two, so that damped Gauss-Newton
// steps in length and period find the minimum (variable projection). Solid fractions of
// neighbouring bins come from the same grains, so their noise is correlated and the residuals do
// not tell the errors. These are jackknife errors instead: with the n profiles, of one packing
// each, left out one at a time,
//   error^2 = (n - 1) / n  sum (p_k - mean p)^2     (Efron and Stein 1981),
// times Student's t with n - 1 degrees of freedom over 1.96, at 97.5 %, so that two errors on
// either side contain the truth in 95 % of all sweeps however few profiles there are.
//
// The sum of squares has several minima. Where another one, at a length beyond those two errors,
// exceeds the least by less than two such errors of that excess, the layers have no single length.
#pragma once

#include <string>
#include <vector>

namespace grainsweep {

/// Start of the window, d from the wall: nearer to it the profile rises from the wall itself.
inline constexpr double decay_window_start = 0.25;

/// Share of the bulk solid fraction below which an oscillation no longer counts as reach of
/// the wall: a convention, not a result.
inline constexpr double decay_reach_share = 0.05;

/// A misfit above this is no chance: a damped cosine does not describe such layers, however small
/// the error of the length.
inline constexpr double largest_misfit = 2.0;

/// A fitted number and its standard error.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

struct DecayFit {
  std::string not_determined;  ///< why there are no numbers; empty if there are
  Estimate bulk;               ///< solid fraction far from the wall
  Estimate amplitude;          ///< positive, extrapolated to the wall
  Estimate length;             ///< lambda, d
  Estimate period;             ///< d
  Estimate phase;              ///< rad
  /// Where the amplitude has fallen to decay_reach_share of bulk, d; may be extrapolated, see
  /// why_no_reach.
  Estimate reach;
  double r_squared = 0.0;   ///< share of the mean profile's variance that the curve explains
  double misfit = 0.0;      ///< root mean square of residuals over that of the mean's errors
  double window_end = 0.0;  ///< d from the wall
  int bins = 0;             ///< in the window
};

/// Why the reach has no value: the curve has none, or falls to decay_reach_share of bulk only
/// beyond the window, where nothing was measured of it; empty if it has one.
std::string why_no_reach(const DecayFit& fit);

/// Fits the mean of `profiles`, solid fractions in bins from the wall inwards, over the bins whose
/// centres lie between decay_window_start and `window_end`. There must be two profiles or more,
/// each with all bins of the window. Not determined if the window holds too few bins or no whole
/// period, if the method does not converge, if the curve is lost in the noise or if curves of two
/// lengths describe the layers equally well.
DecayFit fit_decay(const std::vector<std::vector<double>>& profiles, double bin_width,
                   double window_end);

}  // namespace grainsweep
