#include "engine/measure/decay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Cholesky>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

// Loops instead of expressions of Eigen, whose templates take longer to compile than all the rest.
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int parameter_count = 5;
constexpr int least_bins = 2 * parameter_count;
constexpr double least_explained = 0.5;     // of the variance; below it is no damped oscillation
constexpr double least_significance = 3.0;  // of the amplitude at the window's start, in errors
constexpr double largest_relative_error = 0.5;  // of the length

/// The curve's parameters as they are fitted: bulk; a and b, the amplitude at the window's start
/// times cosine and sine of the phase there; logarithms of length and period, which keep them
/// positive. Distances are from the window's start.
enum Entry : Index { bulk = 0, a = 1, b = 2, log_length = 3, log_period = 4 };

double squared(double value) { return value * value; }

/// Bins of the window: distance of their centres from its start, and solid fractions.
struct Window {
  std::vector<double> distance, value;

  Index bins() const { return static_cast<Index>(value.size()); }
};

/// Damped cosine and sine at a distance.
struct Wave {
  double cosine, sine;
};

Wave wave_at(double distance, double length, double period) {
  const double damping = std::exp(-distance / length), angle = 2.0 * pi / period * distance;
  return {damping * std::cos(angle), damping * std::sin(angle)};
}

/// The curve less the window's values.
VectorXd misses(const VectorXd& p, const Window& window) {
  const double length = std::exp(p[log_length]), period = std::exp(p[log_period]);
  VectorXd values(window.bins());
  for (std::size_t k = 0; k < window.value.size(); ++k) {
    const Wave w = wave_at(window.distance[k], length, period);
    values[static_cast<Index>(k)] = p[bulk] + p[a] * w.cosine - p[b] * w.sine - window.value[k];
  }
  return values;
}

/// Residuals and their derivatives, in the form the Levenberg-Marquardt method asks for.
struct Residuals : Eigen::DenseFunctor<double> {
  explicit Residuals(const Window& bins)
      : DenseFunctor(parameter_count, static_cast<int>(bins.bins())), window(bins) {}

  int operator()(const VectorXd& p, VectorXd& residual) const {
    residual = misses(p, window);
    return 0;
  }
  int df(const VectorXd& p, MatrixXd& derivative) const {
    const double length = std::exp(p[log_length]), period = std::exp(p[log_period]);
    for (Index k = 0; k < window.bins(); ++k) {
      const double distance = window.distance[static_cast<std::size_t>(k)];
      const Wave w = wave_at(distance, length, period);
      derivative(k, bulk) = 1.0;
      derivative(k, a) = w.cosine;
      derivative(k, b) = -w.sine;
      derivative(k, log_length) = (p[a] * w.cosine - p[b] * w.sine) * distance / length;
      derivative(k, log_period) =
          (p[a] * w.sine + p[b] * w.cosine) * distance * (2.0 * pi / period);
    }
    return 0;
  }

  const Window& window;
};

/// The best bulk, a and b for a given length and period, by linear least squares.
VectorXd best_linear(const Window& window, double length, double period) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < window.value.size(); ++k) {
    const Wave w = wave_at(window.distance[k], length, period);
    const Eigen::Vector3d row(1.0, w.cosine, -w.sine);
    normal += row * row.transpose();
    right += window.value[k] * row;
  }
  const Eigen::Vector3d best = normal.ldlt().solve(right);
  VectorXd p(parameter_count);
  for (const Entry linear : {bulk, a, b}) p[linear] = best[linear];
  p[log_length] = std::log(length);
  p[log_period] = std::log(period);
  return p;
}

double squared_distance(const VectorXd& p, const Window& window) {
  return misses(p, window).squaredNorm();
}

/// The best point of a grid that spans what layers of grains of .1 d to 1 d can do.
VectorXd best_of_grid(const Window& window) {
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (double length = 0.2; length < 8.0; length *= 1.5) {
    for (double period = 0.15; period < 1.6; period *= 1.06) {
      const VectorXd p = best_linear(window, length, period);
      const double squared = squared_distance(p, window);
      if (squared < least) {
        least = squared;
        best = p;
      }
    }
  }
  return best;
}

/// The minimum next to `start`; nothing if the method does not arrive there.
std::optional<VectorXd> minimum_near(VectorXd start, const Window& window) {
  using Eigen::LevenbergMarquardtSpace::Status;
  if (start.size() != parameter_count || !start.allFinite()) return std::nullopt;
  Residuals residuals(window);
  Eigen::LevenbergMarquardt<Residuals> method(residuals);
  method.setMaxfev(1000);
  const Status status = method.minimize(start);
  const bool has_failed = status == Status::ImproperInputParameters ||
                          status == Status::TooManyFunctionEvaluation ||
                          status == Status::UserAsked;
  return has_failed || !start.allFinite() ? std::nullopt : std::optional(start);
}

/// Mean of the profiles over the window; `left_out` is the profile to leave out, or none.
Window mean_window(const std::vector<std::vector<double>>& profiles, double bin_width,
                   double window_end, std::size_t left_out) {
  Window window;
  for (std::size_t k = 0; k < profiles.front().size(); ++k) {
    const double y = (static_cast<double>(k) + 0.5) * bin_width;
    if (y < decay_window_start || y > window_end) continue;
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      sum += i == left_out ? 0.0 : profiles[i][k];
      count += i == left_out ? 0.0 : 1.0;
    }
    window.distance.push_back(y - decay_window_start);
    window.value.push_back(sum / count);
  }
  return window;
}

/// Mean square of the standard error of the mean profile, over the window.
double mean_squared_error(const std::vector<std::vector<double>>& profiles, double bin_width,
                          double window_end, const Window& mean) {
  const auto n = static_cast<double>(profiles.size());
  double squares = 0.0;
  for (const auto& profile : profiles) {
    const Window one =
        mean_window({profile}, bin_width, window_end, std::numeric_limits<std::size_t>::max());
    for (std::size_t k = 0; k < mean.value.size(); ++k) {
      squares += squared(one.value[k] - mean.value[k]);
    }
  }
  return squares / (n * (n - 1.0)) / static_cast<double>(mean.value.size());
}

/// Sum of the squared deviations from the mean.
double sum_of_squares(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  for (const double value : values)
    squares += squared(value - sum / static_cast<double>(values.size()));
  return squares;
}

/// What a user reads: amplitude and phase at the wall, length, period and reach in d.
VectorXd readable(const VectorXd& p) {
  const double length = std::exp(p[log_length]), period = std::exp(p[log_period]);
  const double amplitude = std::hypot(p[a], p[b]) * std::exp(decay_window_start / length);
  const double reach = length * std::log(amplitude / (decay_reach_share * p[bulk]));
  VectorXd values(parameter_count + 1);
  values[0] = p[bulk];
  values[1] = amplitude;
  values[2] =
      std::remainder(std::atan2(p[b], p[a]) - 2.0 * pi * decay_window_start / period, 2.0 * pi);
  values[3] = length;
  values[4] = period;
  values[5] = std::max(0.0, reach);
  return values;
}

/// Jackknife errors from the values of the fits without each profile.
VectorXd jackknife_errors(const std::vector<VectorXd>& values) {
  const auto n = static_cast<double>(values.size());
  VectorXd errors(values.front().size());
  for (Index k = 0; k < errors.size(); ++k) {
    double mean = 0.0, squares = 0.0;
    for (const VectorXd& value : values) mean += value[k] / n;
    for (const VectorXd& value : values) squares += squared(value[k] - mean);
    errors[k] = std::sqrt((n - 1.0) / n * squares);
  }
  return errors;
}

/// Why the window cannot hold a fit; empty if it can.
std::string fault_of_window(const Window& window, double variation, double bin_width,
                            double window_end) {
  constexpr double rounding = 1e-12;  // of sums of volumes
  if (window.bins() >= least_bins) {
    return std::sqrt(variation) > rounding ? "" : "the solid fraction is the same in all bins";
  }
  return "the window from " + number_text(decay_window_start) + " d to " + number_text(window_end) +
         " d holds " + std::to_string(window.value.size()) + " bins of " + number_text(bin_width) +
         " d, a fit needs " + std::to_string(least_bins) +
         "; make measure.bin_width smaller or the gap between the walls wider";
}

/// Why a converged curve does not determine a length; empty if it does.
std::string fault_of_curve(const DecayFit& fit, double significance) {
  const double span = fit.window_end - decay_window_start;
  const std::string length =
      number_text(fit.length.value) + " +- " + number_text(fit.length.error) + " d";
  if (!(significance >= least_significance)) {
    return "the oscillation is lost in the noise: its amplitude is " + number_text(significance) +
           " standard errors at the start of the window, " + number_text(least_significance) +
           " are needed; add replicates";
  }
  if (!(fit.period.value <= span)) {
    return "the window of " + number_text(span) + " d holds no whole period";
  }
  if (!(fit.length.value <= span)) {
    return "the fitted length " + length + " is longer than the window of " + number_text(span) +
           " d";
  }
  if (!(fit.length.error <= largest_relative_error * fit.length.value)) {
    return "the length " + length + " is too uncertain; add replicates";
  }
  if (!(fit.r_squared >= least_explained)) {
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

/// Fits without each profile in turn, as they are fitted and as they are read; empty if one fails.
struct PartialFits {
  std::vector<VectorXd> fitted, read;
};
PartialFits fits_without_each(const std::vector<std::vector<double>>& profiles, double bin_width,
                              double window_end, const VectorXd& whole) {
  PartialFits parts;
  const double phase = readable(whole)[2];
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const auto p = minimum_near(whole, mean_window(profiles, bin_width, window_end, i));
    if (!p) return {};
    parts.fitted.push_back(*p);
    VectorXd values = readable(*p);
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

}  // namespace

DecayFit fit_decay(const std::vector<std::vector<double>>& profiles, double bin_width,
                   double window_end) {
  DecayFit fit;
  fit.window_end = window_end;
  const Window window =
      mean_window(profiles, bin_width, window_end, std::numeric_limits<std::size_t>::max());
  fit.bins = static_cast<int>(window.bins());
  const double variation = sum_of_squares(window.value);
  const std::string fault = fault_of_window(window, variation, bin_width, window_end);
  if (!fault.empty()) return not_determined(fit, fault);
  const auto whole = minimum_near(best_of_grid(window), window);
  const PartialFits parts =
      whole ? fits_without_each(profiles, bin_width, window_end, *whole) : PartialFits{};
  if (parts.read.empty()) return not_determined(fit, "the fit does not converge");
  take_values(readable(*whole), jackknife_errors(parts.read), fit);
  const double squares = squared_distance(*whole, window);
  fit.r_squared = 1.0 - squares / variation;
  fit.misfit =
      std::sqrt(squares / fit.bins / mean_squared_error(profiles, bin_width, window_end, window));
  const std::string doubt = fault_of_curve(fit, significance_of(*whole, parts));
  return doubt.empty() ? fit : not_determined(fit, doubt);
}

}  // namespace grainsweep
