#include "runner/analysis/decay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>

#include "engine/text.hpp"
#include "engine/units.hpp"
#include "runner/analysis/student.hpp"

namespace grainsweep {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int parameter_count = 5;
constexpr int min_bins = 2 * parameter_count;
constexpr double min_explained = 0.5;     // of the variance; below it is no damped oscillation
constexpr double min_significance = 3.0;  // of the amplitude at the window's start, in errors
constexpr double largest_relative_error = 0.5;  // of the length

/// The curve's parameters as they are fitted: bulk; a and b, the amplitude at the window's start
/// times cosine and sine of the phase there; logarithms of length and period, which keep them
/// positive. Distances are from the window's start.
enum Entry : Index { bulk = 0, a = 1, b = 2, log_length = 3, log_period = 4 };

/// Bins of the window: distance of their centres from its start, and solid fractions.
struct Window {
  ArrayXd distance;
  VectorXd value;
};

struct Waves {
  ArrayXd cosine, sine;  ///< damped
};

Waves waves_of(const ArrayXd& distance, double length, double period) {
  const ArrayXd damping = (-distance / length).exp(), angle = 2.0 * pi / period * distance;
  return {damping * angle.cos(), damping * angle.sin()};
}

/// What bulk, a and b multiply.
using LinearColumns = std::array<VectorXd, 3>;

LinearColumns columns_of(const Window& window, double log_length, double log_period) {
  const Waves w = waves_of(window.distance, std::exp(log_length), std::exp(log_period));
  return {VectorXd::Ones(window.value.size()), w.cosine.matrix(), -w.sine.matrix()};
}

/// The coefficients of the columns that describe `values` best: linear least squares.
Eigen::Vector3d coefficients_of(const LinearColumns& columns, const VectorXd& values) {
  Eigen::Matrix3d normal;
  Eigen::Vector3d right;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Index>(i);
    for (std::size_t j = 0; j < 3; ++j) {
      normal(row, static_cast<Index>(j)) = columns[i].dot(columns[j]);
    }
    right[row] = columns[i].dot(values);
  }
  return normal.ldlt().solve(right);
}

/// What is left of `values` after the combination of columns with these coefficients.
VectorXd remainder_of(VectorXd values, const LinearColumns& columns, const Eigen::Vector3d& by) {
  for (std::size_t i = 0; i < 3; ++i) values -= by[static_cast<Index>(i)] * columns[i];
  return values;
}

/// The curve with the best bulk, a and b for its length and period.
struct FittedCurve {
  VectorXd p;             ///< by Entry
  LinearColumns columns;  ///< of that length and period
  VectorXd residual;      ///< solid fractions less the curve
};

FittedCurve best_curve(const Window& window, double log_length, double log_period) {
  FittedCurve best{VectorXd(parameter_count), columns_of(window, log_length, log_period), {}};
  const Eigen::Vector3d linear = coefficients_of(best.columns, window.value);
  best.p << linear[bulk], linear[a], linear[b], log_length, log_period;
  best.residual = remainder_of(window.value, best.columns, linear);
  return best;
}

/// How the curve changes with the logarithms of length and period when bulk, a and b follow them,
/// but for a part that is orthogonal to the residuals: its derivatives, less what its columns can
/// describe (variable projection; Golub and Pereyra 1973, Kaufman 1975).
std::array<VectorXd, 2> derivatives_of(const FittedCurve& curve, const Window& window) {
  const double length = std::exp(curve.p[log_length]), period = std::exp(curve.p[log_period]);
  const ArrayXd cosine = curve.columns[1].array(), sine = -curve.columns[2].array();
  const ArrayXd wave = curve.p[a] * cosine - curve.p[b] * sine;
  const ArrayXd turned = curve.p[a] * sine + curve.p[b] * cosine;
  std::array<VectorXd, 2> changes = {(wave * window.distance / length).matrix(),
                                     (turned * window.distance * (2.0 * pi / period)).matrix()};
  for (VectorXd& change : changes) {
    change = remainder_of(change, curve.columns, coefficients_of(curve.columns, change));
  }
  return changes;
}

/// Gauss-Newton step in the logarithms of length and period, damped as by Marquardt, of 1 at most.
Eigen::Vector2d step_of(const FittedCurve& curve, const Window& window, double damping) {
  const auto [by_length, by_period] = derivatives_of(curve, window);
  const double ll = (1.0 + damping) * by_length.squaredNorm(), lp = by_length.dot(by_period),
               pp = (1.0 + damping) * by_period.squaredNorm();
  const double l = by_length.dot(curve.residual), p = by_period.dot(curve.residual);
  const double determinant = ll * pp - lp * lp;
  const Eigen::Vector2d step((pp * l - lp * p) / determinant, (ll * p - lp * l) / determinant);
  return step.cwiseMax(-1.0).cwiseMin(1.0);
}

/// The minimum next to `curve` in length and period, by Gauss-Newton steps, damped after Levenberg
/// and Marquardt where they lead uphill; nothing if they do not converge.
std::optional<FittedCurve> minimum_near(FittedCurve curve, const Window& window) {
  constexpr int most_steps = 1000;
  constexpr double least_step = 1e-9;    // in the logarithms of length and period
  constexpr double least_gain = 1e-13;   // of the squares: a step by 3e-7 standard errors
  constexpr double most_damping = 1e12;  // no way down is left but rounding
  double damping = 1e-3;
  for (int step = 0; step < most_steps && curve.residual.allFinite(); ++step) {
    const Eigen::Vector2d move = step_of(curve, window, damping);
    FittedCurve next =
        best_curve(window, curve.p[log_length] + move[0], curve.p[log_period] + move[1]);
    const double squares = curve.residual.squaredNorm();
    const double gain = squares - next.residual.squaredNorm();
    const bool is_downhill = gain >= 0.0;
    if (is_downhill) curve = std::move(next);
    const bool is_short =
        move.cwiseAbs().maxCoeff() <= least_step || std::abs(gain) <= least_gain * squares;
    if ((is_short && damping < 1.0) || damping > most_damping) return curve;
    damping *= is_downhill ? 0.1 : 10.0;
  }
  return std::nullopt;
}

/// Lengths and periods that span what layers of grains of 0.1 d to 1 d can do.
std::vector<double> powers(double first, double last, double ratio) {
  std::vector<double> values;
  for (double value = first; value < last; value *= ratio) values.push_back(value);
  return values;
}

/// The minima next to those points of a grid that are lower than all around them, the lowest first.
/// A wave shorter than two bins looks like a longer one there, and is never meant.
std::vector<FittedCurve> minima_of(const Window& window) {
  const double shortest = 2.0 * (window.distance[1] - window.distance[0]);
  const std::vector<double> lengths = powers(0.2, 8.0, 1.5),
                            periods = powers(std::max(0.15, shortest), 1.6, 1.06);
  const auto rows = static_cast<Index>(lengths.size()),
             columns = static_cast<Index>(periods.size());
  const auto curve_at = [&](Index i, Index j) {
    return best_curve(window, std::log(lengths[static_cast<std::size_t>(i)]),
                      std::log(periods[static_cast<std::size_t>(j)]));
  };
  Eigen::ArrayXXd squares(rows + 2, columns + 2);  // with a rim
  squares.setConstant(std::numeric_limits<double>::infinity());
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      squares(i + 1, j + 1) = curve_at(i, j).residual.squaredNorm();
    }
  }
  std::vector<FittedCurve> minima;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      if (!(squares(i + 1, j + 1) <= squares.block<3, 3>(i, j).minCoeff())) continue;
      const auto minimum = minimum_near(curve_at(i, j), window);
      const bool is_meant = minimum && std::exp(minimum->p[log_period]) >= shortest;
      if (is_meant) minima.push_back(*minimum);
    }
  }
  std::stable_sort(minima.begin(), minima.end(),
                   [](const FittedCurve& one, const FittedCurve& two) {
                     return one.residual.squaredNorm() < two.residual.squaredNorm();
                   });
  return minima;
}

/// Mean of the profiles over the window; `left_out` is the profile to leave out, or none.
Window mean_window(const std::vector<std::vector<double>>& profiles, double bin_width,
                   double window_end, std::size_t left_out) {
  std::vector<double> distances, values;
  const double rounding = 1e-9 * bin_width;  // of widths over their number of bins
  for (std::size_t k = 0; k < profiles.front().size(); ++k) {
    const double y = (static_cast<double>(k) + 0.5) * bin_width;
    if (y < decay_window_start - rounding || y > window_end + rounding) continue;
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      sum += i == left_out ? 0.0 : profiles[i][k];
      count += i == left_out ? 0.0 : 1.0;
    }
    distances.push_back(y - decay_window_start);
    values.push_back(sum / count);
  }
  const auto bins = static_cast<Index>(values.size());
  return {Eigen::Map<ArrayXd>(distances.data(), bins), Eigen::Map<VectorXd>(values.data(), bins)};
}

/// Mean square of the standard error of the mean profile, over the window.
double mean_squared_error(const std::vector<std::vector<double>>& profiles, double bin_width,
                          double window_end, const Window& mean) {
  const auto n = static_cast<double>(profiles.size());
  double squares = 0.0;
  for (const auto& profile : profiles) {
    const Window one =
        mean_window({profile}, bin_width, window_end, std::numeric_limits<std::size_t>::max());
    squares += (one.value - mean.value).squaredNorm();
  }
  return squares / (n * (n - 1.0)) / static_cast<double>(mean.value.size());
}

VectorXd deviations(const VectorXd& values) {
  if (values.size() == 0) return values;
  return (values.array() - values.mean()).matrix();
}

/// What a user reads: amplitude and phase at the wall, length, period and reach in d.
VectorXd readable(const VectorXd& p) {
  const double length = std::exp(p[log_length]), period = std::exp(p[log_period]);
  const double amplitude = std::hypot(p[a], p[b]) * std::exp(decay_window_start / length);
  const double reach = length * std::log(amplitude / (decay_reach_share * p[bulk]));
  VectorXd values(parameter_count + 1);
  values << p[bulk], amplitude,
      std::remainder(std::atan2(p[b], p[a]) - 2.0 * pi * decay_window_start / period, 2.0 * pi),
      length, period, std::max(0.0, reach);
  return values;
}

/// Jackknife errors from the values of the fits without each profile.
VectorXd jackknife_errors(const std::vector<VectorXd>& values) {
  const auto n = static_cast<double>(values.size());
  VectorXd mean = VectorXd::Zero(values.front().size()), squares = mean;
  for (const VectorXd& value : values) mean += value / n;
  for (const VectorXd& value : values) squares += (value - mean).cwiseAbs2();
  return ((n - 1.0) / n * squares).cwiseSqrt();
}

/// The same, widened so that two of them on either side contain the truth in 95 %.
VectorXd widened_errors(const std::vector<VectorXd>& values) {
  const double widening = student_quantile(static_cast<int>(values.size()) - 1) / normal_quantile;
  return widening * jackknife_errors(values);
}

/// Why the window cannot hold a fit; empty if it can.
std::string fault_of_window(const Window& window, const VectorXd& centred, double bin_width,
                            double window_end) {
  constexpr double rounding = 1e-12;  // of sums of volumes
  if (window.value.size() >= min_bins) {
    return centred.norm() > rounding ? "" : "the solid fraction is the same in all bins";
  }
  return "the window from " + number_text(decay_window_start) + " d to " + number_text(window_end) +
         " d holds " + std::to_string(window.value.size()) + " bins of " + number_text(bin_width) +
         " d, a fit needs " + std::to_string(min_bins) +
         "; make measure.bin_width smaller or the container wider";
}

/// Why a converged curve does not determine a length; empty if it does.
std::string fault_of_curve(const DecayFit& fit, double significance) {
  const double span = fit.window_end - decay_window_start;
  constexpr double unbounded = 10.0;  // times the length
  const bool has_bound = fit.length.error <= unbounded * fit.length.value;
  const std::string error = has_bound ? " +- " + number_text(fit.length.error) + " d"
                                      : " d, without a bound on its error,";
  if (!(significance >= min_significance)) {
    return "the oscillation is lost in the noise: its amplitude is " + number_text(significance) +
           " standard errors at the start of the window, " + number_text(min_significance) +
           " are needed; add replicates";
  }
  if (!(fit.period.value <= span)) {
    return "the window of " + number_text(span) + " d holds no whole period";
  }
  if (!(fit.length.value <= span)) {
    return "the layers do not decay within the window of " + number_text(span) + " d";
  }
  if (!(fit.length.error <= largest_relative_error * fit.length.value)) {
    return "the length " + number_text(fit.length.value) + error +
           " is too uncertain; add replicates";
  }
  if (!(fit.r_squared >= min_explained)) {
    return "a damped oscillation explains only " + number_text(fit.r_squared) + " of the variance";
  }
  return {};
}

DecayFit not_determined(const DecayFit& fit, std::string reason) {
  DecayFit empty;
  empty.not_determined = std::move(reason);
  empty.window_end = fit.window_end;
  empty.bins = fit.bins;
  return empty;
}

void take_values(const VectorXd& values, const VectorXd& errors, DecayFit& fit) {
  fit.bulk = {values[0], errors[0]};
  fit.amplitude = {values[1], errors[1]};
  fit.phase = {values[2], errors[2]};
  fit.length = {values[3], errors[3]};
  fit.period = {values[4], errors[4]};
  fit.reach = {values[5], errors[5]};
}

/// Fits without each profile in turn, as they are fitted and as they are read; empty if one fails
/// or runs away to a wave so long that nothing of it is left in the window.
struct PartialFits {
  std::vector<VectorXd> fitted, read;
};
constexpr double longest_wave = 10.0;  // windows
PartialFits fits_of(const std::vector<Window>& windows, const VectorXd& whole) {
  PartialFits parts;
  const double phase = readable(whole)[2];
  for (const Window& window : windows) {
    const auto curve =
        minimum_near(best_curve(window, whole[log_length], whole[log_period]), window);
    const double span = window.distance[window.distance.size() - 1];
    if (!curve || std::exp(curve->p[log_period]) > longest_wave * span) return {};
    parts.fitted.push_back(curve->p);
    VectorXd values = readable(curve->p);
    values[2] = phase + std::remainder(values[2] - phase, 2.0 * pi);
    parts.read.push_back(values);
  }
  return parts;
}

/// Amplitude at the window's start over its jackknife error.
double significance_of(const VectorXd& whole, const PartialFits& parts) {
  const VectorXd errors = jackknife_errors(parts.fitted);
  return std::hypot(whole[a], whole[b]) / std::hypot(errors[a], errors[b]);
}

/// By how much the squared residuals of one length and period exceed those of another.
double excess_of(const VectorXd& other, const VectorXd& best, const Window& window) {
  const auto squares = [&](const VectorXd& p) {
    return best_curve(window, p[log_length], p[log_period]).residual.squaredNorm();
  };
  return squares(other) - squares(best);
}

/// What a reader must know about another curve that describes the layers equally well, with a
/// length beyond the error of the best and not below a bin; empty if there is none.
std::string rival_of(const DecayFit& fit, const std::vector<FittedCurve>& minima,
                     const Window& window, const std::vector<Window>& without_each) {
  constexpr double least_excess = 2.0;  // in errors
  const double span = fit.window_end - decay_window_start;
  for (std::size_t k = 1; k < minima.size(); ++k) {
    const VectorXd &best = minima[0].p, &other = minima[k].p;
    const double length = std::exp(other[log_length]);
    const bool is_one = std::abs(length - fit.length.value) <= 2.0 * fit.length.error;
    if (is_one || length < window.distance[1] - window.distance[0]) continue;
    std::vector<VectorXd> excess;
    excess.reserve(without_each.size());
    for (const Window& part : without_each) {
      excess.emplace_back(VectorXd::Constant(1, excess_of(other, best, part)));
    }
    if (excess_of(other, best, window) < least_excess * widened_errors(excess)[0]) {
      const std::string first =
          "two lengths describe the layers as well: " + number_text(fit.length.value) + " d and ";
      return first +
             (length <= span
                  ? number_text(length) + " d"
                  : "one without a decay within the window of " + number_text(span) + " d") +
             "; add replicates";
    }
  }
  return "";
}

}  // namespace

std::string why_no_reach(const DecayFit& fit) {
  if (!fit.not_determined.empty() || fit.reach.value <= fit.window_end) return fit.not_determined;
  return "the curve falls to " + number_text(100.0 * decay_reach_share) +
         " % of the bulk only beyond the middle, " + number_text(fit.window_end) +
         " d from the wall, where the fit ends";
}

DecayFit fit_decay(const std::vector<std::vector<double>>& profiles, double bin_width,
                   double window_end) {
  DecayFit fit;
  fit.window_end = window_end;
  const Window window =
      mean_window(profiles, bin_width, window_end, std::numeric_limits<std::size_t>::max());
  fit.bins = static_cast<int>(window.value.size());
  const VectorXd centred = deviations(window.value);
  const std::string fault = fault_of_window(window, centred, bin_width, window_end);
  if (!fault.empty()) return not_determined(fit, fault);
  const std::vector<FittedCurve> minima = minima_of(window);
  std::vector<Window> without_each;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    without_each.push_back(mean_window(profiles, bin_width, window_end, i));
  }
  if (minima.empty()) return not_determined(fit, "the fit does not converge");
  const PartialFits parts = fits_of(without_each, minima[0].p);
  if (parts.read.empty()) {
    return not_determined(fit,
                          "the fit without one of the packings does not converge; add replicates");
  }
  const FittedCurve& whole = minima[0];
  take_values(readable(whole.p), widened_errors(parts.read), fit);
  const double squares = whole.residual.squaredNorm();
  fit.r_squared = 1.0 - squares / centred.squaredNorm();
  fit.misfit =
      std::sqrt(squares / fit.bins / mean_squared_error(profiles, bin_width, window_end, window));
  std::string doubt = fault_of_curve(fit, significance_of(whole.p, parts));
  if (doubt.empty()) doubt = rival_of(fit, minima, window, without_each);
  return doubt.empty() ? fit : not_determined(fit, doubt);
}

}  // namespace grainsweep
