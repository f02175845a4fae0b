#include "engine/measure/decay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Dense>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
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

VectorXd curve(const VectorXd& p, const ArrayXd& distance) {
  const Waves w = waves_of(distance, std::exp(p[log_length]), std::exp(p[log_period]));
  return (p[bulk] + p[a] * w.cosine - p[b] * w.sine).matrix();
}

/// Residuals and their derivatives, in the form the Levenberg-Marquardt method asks for.
struct Residuals : Eigen::DenseFunctor<double> {
  explicit Residuals(const Window& bins)
      : DenseFunctor(parameter_count, static_cast<int>(bins.value.size())), window(bins) {}

  int operator()(const VectorXd& p, VectorXd& residual) const {
    residual = curve(p, window.distance) - window.value;
    return 0;
  }
  int df(const VectorXd& p, MatrixXd& derivative) const {
    const double length = std::exp(p[log_length]), period = std::exp(p[log_period]);
    const Waves w = waves_of(window.distance, length, period);
    const ArrayXd wave = p[a] * w.cosine - p[b] * w.sine, turned = p[a] * w.sine + p[b] * w.cosine;
    derivative.col(bulk).setOnes();
    derivative.col(a) = w.cosine.matrix();
    derivative.col(b) = -w.sine.matrix();
    derivative.col(log_length) = (wave * window.distance / length).matrix();
    derivative.col(log_period) = (turned * window.distance * (2.0 * pi / period)).matrix();
    return 0;
  }

  const Window& window;
};

/// The best bulk, a and b for a given length and period, by linear least squares.
VectorXd best_linear(const Window& window, double length, double period) {
  const Waves w = waves_of(window.distance, length, period);
  MatrixXd columns(window.value.size(), 3);
  columns << VectorXd::Ones(window.value.size()), w.cosine.matrix(), -w.sine.matrix();
  const MatrixXd normal = columns.transpose() * columns;
  VectorXd p(parameter_count);
  p.head(3) = normal.ldlt().solve(columns.transpose() * window.value);
  p[log_length] = std::log(length);
  p[log_period] = std::log(period);
  return p;
}

double squared_distance(const VectorXd& p, const Window& window) {
  return (curve(p, window.distance) - window.value).squaredNorm();
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
  std::vector<double> distances, values;
  for (std::size_t k = 0; k < profiles.front().size(); ++k) {
    const double y = (static_cast<double>(k) + 0.5) * bin_width;
    if (y < decay_window_start || y > window_end) continue;
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
         "; make measure.bin_width smaller or the gap between the walls wider";
}

/// Why a converged curve does not determine a length; empty if it does.
std::string fault_of_curve(const DecayFit& fit, double significance) {
  const double span = fit.window_end - decay_window_start;
  const std::string length =
      number_text(fit.length.value) + " +- " + number_text(fit.length.error) + " d";
  if (!(significance >= min_significance)) {
    return "the oscillation is lost in the noise: its amplitude is " + number_text(significance) +
           " standard errors at the start of the window, " + number_text(min_significance) +
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
  fit.bins = static_cast<int>(window.value.size());
  const VectorXd centred = deviations(window.value);
  const std::string fault = fault_of_window(window, centred, bin_width, window_end);
  if (!fault.empty()) return not_determined(fit, fault);
  const auto whole = minimum_near(best_of_grid(window), window);
  const PartialFits parts =
      whole ? fits_without_each(profiles, bin_width, window_end, *whole) : PartialFits{};
  if (parts.read.empty()) return not_determined(fit, "the fit does not converge");
  take_values(readable(*whole), jackknife_errors(parts.read), fit);
  const double squares = squared_distance(*whole, window);
  fit.r_squared = 1.0 - squares / centred.squaredNorm();
  fit.misfit =
      std::sqrt(squares / fit.bins / mean_squared_error(profiles, bin_width, window_end, window));
  const std::string doubt = fault_of_curve(fit, significance_of(*whole, parts));
  return doubt.empty() ? fit : not_determined(fit, doubt);
}

}  // namespace grainsweep
