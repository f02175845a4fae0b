#include "engine/dynamics/settle.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/balance.hpp"

namespace grainsweep {

namespace {

// The fall ends when the floor carries the bed and the bed has lost its speed.
constexpr double carried_share = 0.9;
constexpr double fall_energy = 5e-3;  // m g d per grain; an impact has about 0.2

// Steps after the fall, in steps of the fall. Motions and overlaps go with the square of a step.
constexpr double creep_step = 2.0;
constexpr double quench_step = 0.5;

// Contacts go on closing for about ten steps of a quench, after that it only creeps.
constexpr std::int64_t least_quench_steps = 10;

enum class Stage { fall, creep, quench };

/// Everything a settling bed carries from step to step.
template <class Real>
struct Settling {
  const Accuracy& accuracy;
  const Kernels& kernels;
  const KeepGoing& keep_going;
  SphereBed& bed;
  StepState<Real> state;
  StepSettings settings;
  StepReport last;
  SettleReport report;
};

StepSettings settings_of(const Accuracy& accuracy, Stage stage) {
  StepSettings s;
  s.dt = accuracy.step;
  s.momentum = accuracy.momentum;
  s.limits = {accuracy.solver, accuracy.rest_iterations, accuracy.residual_tolerance / 5.0};
  if (stage == Stage::fall) {
    s.limits.iterations = accuracy.fall_iterations;
  } else {
    s.near = s.margin = stage == Stage::creep ? 0.03 : 0.02;
    s.dt *= stage == Stage::creep ? creep_step : quench_step;
    s.momentum = 0.0;
    s.correction = 1.0;
  }
  return s;
}

/// Velocities stay as they are when the step changes: motions scale with dt, impulses with dt^2.
template <class Real>
void enter(Stage stage, Settling<Real>& s) {
  const double before = s.settings.dt;
  s.settings = settings_of(s.accuracy, stage);
  s.state.has_candidates = false;
  const double ratio = s.settings.dt / before;
  for (Record<double>& motion : s.bed.motion) {
    motion.x *= ratio;
    motion.y *= ratio;
    motion.z *= ratio;
  }
  for (Real& impulse : s.state.contacts.impulse) {
    impulse *= static_cast<Real>(ratio * ratio);
  }
}

/// Share of the work done, from the stage and its steps: an estimate for progress bars.
template <class Real>
double share_done(const Settling<Real>& s, Stage stage, std::int64_t steps_in_stage) {
  constexpr double begin[] = {0.0, 0.4, 0.7, 1.0};  // typical shares of the time
  const double usual[] = {170.0, std::max(1.0, 1.0 * s.accuracy.creep_steps), 15.0};  // steps
  const auto k = static_cast<std::size_t>(stage);
  const double in_stage = static_cast<double>(steps_in_stage) / usual[k];
  return begin[k] + (begin[k + 1] - begin[k]) * in_stage / (1.0 + in_stage);
}

/// Takes steps of one stage until `is_over` says so, the steps run out or the observer stops it.
template <class Real, class IsOver>
void run(Stage stage, Settling<Real>& s, IsOver is_over) {
  enter(stage, s);
  for (std::int64_t k = 0; s.report.steps < s.accuracy.max_steps && !s.report.cancelled; ++k) {
    if (is_over(k)) {
      return;
    }
    s.last = step(s.settings, s.kernels, s.bed, s.state);
    ++s.report.steps;
    s.report.iterations += s.last.solve.iterations;
    s.report.cancelled = !s.keep_going({s.report.steps, share_done(s, stage, k)});
  }
}

template <class Real>
bool has_fallen(const Settling<Real>& s) {
  return s.last.kinetic_energy < fall_energy &&
         carried_weight(s.bed, s.state.contacts, s.settings.dt) > carried_share;
}

template <class Real>
void certify_rest(Settling<Real>& s) {
  s.report.rest = certify(s.bed, s.kernels, s.settings.dt, s.state.contacts);
  s.report.rest.residual = s.last.solve.residual;
  s.report.rest.kinetic_energy = s.last.kinetic_energy;
  s.report.rest.largest_motion = s.last.largest_motion;
  s.report.why_not = why_not_at_rest(s.report.rest, s.accuracy);
}

template <class Real>
bool is_at_rest(Settling<Real>& s) {
  certify_rest(s);
  return s.report.why_not.empty();
}

template <class Real>
SettleReport settle_as(const Accuracy& accuracy, const Kernels& kernels, SphereBed& bed,
                       const KeepGoing& keep_going) {
  Settling<Real> s{accuracy, kernels, keep_going, bed, {}, settings_of(accuracy, Stage::fall),
                   {},       {}};
  run(Stage::fall, s, [&](std::int64_t k) { return k > 0 && has_fallen(s); });
  run(Stage::creep, s, [&](std::int64_t k) { return k >= accuracy.creep_steps; });
  run(Stage::quench, s, [&](std::int64_t k) { return k >= least_quench_steps && is_at_rest(s); });
  certify_rest(s);
  if (accuracy.force_balance == BalanceCheck::solve && !s.report.cancelled) {
    s.report.balance = balance_forces(bed, kernels, s.settings.dt, s.state.contacts);
  }
  s.report.force = force_sums(bed, s.state.contacts, s.settings.dt);
  return s.report;
}

}  // namespace

SettleReport settle(const Accuracy& accuracy, const Kernels& kernels, SphereBed& bed,
                    const KeepGoing& keep_going) {
  return accuracy.precision == Precision::f32
             ? settle_as<float>(accuracy, kernels, bed, keep_going)
             : settle_as<double>(accuracy, kernels, bed, keep_going);
}

}  // namespace grainsweep
