#include "engine/dynamics/settle.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/balance.hpp"

namespace grainsweep {

namespace {

// The fall ends when the floor carries the bed and the bed has lost its speed.
constexpr double carried_share = 0.9;
constexpr double fall_energy = 5e-3;  // m g d per grain; an impact has about 0.2

constexpr std::int64_t halt_steps = 6;

// Contacts go on closing for about eight steps of a quench, after that it only creeps.
constexpr std::int64_t least_quench_steps = 8;

/// The creep has two parts: its loose and its good solves.
enum class Stage { look, fall, loose_creep, creep, halt, quench, dynamic_fall };

/// What a step takes over from the motion of the last one.
enum class Inertia { none, damped, full };

/// What a stage changes in a step. Motions and overlaps go with the square of a step, so that
/// shorter steps need to look less far.
struct StageRule {
  double step;  ///< in steps of the fall
  Inertia inertia;
  double correction;  ///< share of an overlap that a step repairs
  double near;        ///< pairs with a smaller gap are rows, d
  double margin;      ///< candidates reach this much further, d
  double iterations;  ///< most iterations a step, in rest_iterations
  double usual_end;   ///< share of the work that is usually done at its end
};

constexpr StageRule rules[] = {
    {0.5, Inertia::none, 1.0, 0.01, 0.01, 2.0, 0.0},     // look: a quench before anything else
    {1.0, Inertia::damped, 0.1, 0.08, 0.05, 0.0, 0.3},   // fall: has iterations of its own
    {2.0, Inertia::damped, 1.0, 0.05, 0.01, 0.5, 0.5},   // loose creep
    {2.0, Inertia::damped, 1.0, 0.05, 0.01, 1.0, 0.75},  // creep
    {1.0, Inertia::none, 1.0, 0.02, 0.01, 2.0, 0.85},    // halt
    {0.5, Inertia::none, 1.0, 0.01, 0.01, 2.0, 1.0},     // quench
    {0.25, Inertia::full, 0.0, 0.08, 0.05, 0.0, 0.85},   // dynamic fall: iterations of the fall
};

const StageRule& rule(Stage stage) { return rules[static_cast<std::size_t>(stage)]; }

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

int iterations_of(const Accuracy& accuracy, Stage stage) {
  return stage == Stage::fall
             ? accuracy.fall_iterations
             : std::max(1, static_cast<int>(
                               std::lround(rule(stage).iterations * accuracy.rest_iterations)));
}

double momentum_of(const Accuracy& accuracy, Inertia inertia) {
  return inertia == Inertia::none ? 0.0 : inertia == Inertia::damped ? accuracy.momentum : 1.0;
}

StepSettings settings_of(const Accuracy& accuracy, Stage stage) {
  const StageRule& r = rule(stage);
  StepSettings s;
  s.dt = r.step * accuracy.step;
  s.momentum = momentum_of(accuracy, r.inertia);
  s.correction = r.correction;
  s.near = r.near;
  s.margin = r.margin;
  s.limits = {accuracy.solver, iterations_of(accuracy, stage), accuracy.residual_tolerance / 5.0};
  return s;
}

std::int64_t loose_creep_steps(const Accuracy& accuracy) { return 2 * accuracy.creep_steps / 3; }

/// Steps that a stage usually takes: an estimate for progress bars.
double usual_steps(const Accuracy& accuracy, Stage stage) {
  const auto loose = static_cast<double>(loose_creep_steps(accuracy));
  const double steps[] = {8.0,        160.0, loose, accuracy.creep_steps - loose,
                          halt_steps, 12.0,  1200.0};
  return std::max(1.0, steps[static_cast<std::size_t>(stage)]);
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
  const bool is_first = stage <= Stage::fall || stage == Stage::dynamic_fall;
  const double begin = is_first ? 0.0 : rules[static_cast<std::size_t>(stage) - 1].usual_end;
  const double in_stage = static_cast<double>(steps_in_stage) / usual_steps(s.accuracy, stage);
  return begin + (rule(stage).usual_end - begin) * in_stage / (1.0 + in_stage);
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
bool is_carried(const Settling<Real>& s) {
  return carried_weight(s.bed, s.state.contacts, s.settings.dt) > carried_share;
}

template <class Real>
bool has_fallen(const Settling<Real>& s) {
  return s.last.kinetic_energy < fall_energy && is_carried(s);
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

/// Whether the bed rests as it is, which one that was settled before does; the first step tells of
/// most others.
template <class Real>
bool rests_already(Settling<Real>& s) {
  bool is_bed = true;
  run(Stage::look, s, [&](std::int64_t k) {
    is_bed = is_bed && (k == 0 || is_carried(s));
    return !is_bed || k >= least_quench_steps;
  });
  return is_bed && is_at_rest(s);
}

template <class Real>
void settle_by_heavy_ball(Settling<Real>& s) {
  const std::int64_t loose = loose_creep_steps(s.accuracy);
  const std::int64_t good = s.accuracy.creep_steps - loose;
  run(Stage::fall, s, [&](std::int64_t k) { return k > 0 && has_fallen(s); });
  run(Stage::loose_creep, s, [&](std::int64_t k) { return k >= loose; });
  run(Stage::creep, s, [&](std::int64_t k) { return k >= good; });
  run(Stage::halt, s, [](std::int64_t k) { return k >= halt_steps; });
}

template <class Real>
void settle_by_dynamics(Settling<Real>& s) {
  run(Stage::dynamic_fall, s, [&](std::int64_t k) {
    return k > 0 && has_fallen(s) && s.last.kinetic_energy < s.accuracy.kinetic_tolerance;
  });
}

template <class Real>
void come_down(Settling<Real>& s) {
  if (s.accuracy.protocol == Protocol::dynamic) {
    settle_by_dynamics(s);
  } else {
    settle_by_heavy_ball(s);
  }
}

template <class Real>
SettleReport settle_as(const Accuracy& accuracy, const Kernels& kernels, SphereBed& bed,
                       const KeepGoing& keep_going) {
  Settling<Real> s{accuracy, kernels, keep_going, bed, {}, settings_of(accuracy, Stage::fall),
                   {},       {}};
  if (!rests_already(s)) {
    come_down(s);
    run(Stage::quench, s, [&](std::int64_t k) { return k >= least_quench_steps && is_at_rest(s); });
  }
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
