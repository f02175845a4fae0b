#include "engine/dynamics/stages.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

constexpr double two_thirds = 2.0 / 3.0;

// ---- spheres ----

/// A bed that rests as it is given stays as it is: a few steps of the quench tell.
constexpr StageRule look = {.name = "look",
                            .end = StageEnd::look,
                            .step = 0.5,
                            .correction = 1.0,
                            .near = 0.01,
                            .margin = 0.01,
                            .rest_iterations = 2.0,
                            .steps = 8,
                            .usual_steps = 8};

/// Steps with momentum until the floor carries the bed. Shorter than full ones they need fewer
/// iterations to stray as little, and no more steps: grains in the air fall as fast as they may.
/// Overlaps are repaired slowly, so that loose solves do not throw grains about. An impact has a
/// kinetic energy of about 0.2 m g d.
constexpr StageRule fall = {.name = "fall",
                            .end = StageEnd::fallen,
                            .step = 0.7,
                            .inertia = Inertia::damped,
                            .path = 1.0,
                            .sleeps = true,
                            .correction = 0.1,
                            .near = 0.08,
                            .margin = 0.01,
                            .fall_iterations = 1.0,
                            .steps = 1,
                            .energy = 5e-3,
                            .usual_steps = 160,
                            .done_after = 0.5};

/// Plain contact dynamics: undamped short steps, until impacts alone have taken the energy.
constexpr StageRule dynamic_fall = {.name = "fall",
                                    .end = StageEnd::halted,
                                    .step = 0.25,
                                    .inertia = Inertia::full,
                                    .path = 0.25,
                                    .sleeps = true,
                                    .near = 0.08,
                                    .margin = 0.05,
                                    .fall_iterations = 1.0,
                                    .steps = 1,
                                    .energy = 5e-3,
                                    .usual_steps = 1200,
                                    .done_after = 0.85};

/// Double steps with momentum: grains slide into their places. What repairs of overlaps move is
/// carried on as if it were speed: repaired whole they would throw beds of two sizes apart.
constexpr StageRule creep = {.name = "creep",
                             .step = 2.0,
                             .inertia = Inertia::damped,
                             .path = 1.5,
                             .correction = 0.3,
                             .near = 0.05,
                             .margin = 0.01,
                             .fall_iterations = 1.0,
                             .creep_to = 1.0,
                             .done_before = 0.5,
                             .done_after = 0.75};

/// Full steps without momentum: what still moves is slowed down.
constexpr StageRule halt = {.name = "halt",
                            .path = 0.5,
                            .correction = 1.0,
                            .near = 0.02,
                            .margin = 0.01,
                            .rest_iterations = 2.0,
                            .steps = 6,
                            .usual_steps = 6,
                            .done_before = 0.75,
                            .done_after = 0.85};

/// Half steps without momentum, until every test of rest holds.
constexpr StageRule quench = {.name = "quench",
                              .end = StageEnd::rest,
                              .step = 0.5,
                              .correction = 1.0,
                              .near = 0.01,
                              .margin = 0.01,
                              .rest_iterations = 2.0,
                              .steps = 8,
                              .most_steps = 1000,
                              .usual_steps = 12,
                              .done_before = 0.85,
                              .done_after = 1.0};

constexpr StageRule heavy_ball[] = {look, fall, creep, halt, quench};
constexpr StageRule dynamic[] = {look, dynamic_fall, quench};

// ---- polyhedra ----

constexpr StageRule turning[] = {
    // As that of spheres.
    {.name = "look",
     .end = StageEnd::look,
     .step = 0.25,
     .correction = 0.5,
     .near = 0.03,
     .margin = 0.05,
     .rest_iterations = 1.0,
     .steps = 8,
     .usual_steps = 8},
    // As that of spheres. Polyhedra go on rattling at a few 1e-3 m g d.
    {.name = "fall",
     .end = StageEnd::fallen,
     .inertia = Inertia::damped,
     .path = 1.0,
     .sleeps = true,
     .correction = 0.2,
     .near = 0.05,
     .margin = 0.05,
     .fall_iterations = 1.0,
     .steps = 1,
     .energy = 1e-2,
     .usual_steps = 110,
     .done_after = 0.4},
    // Full steps.
    {.name = "creep",
     .inertia = Inertia::damped,
     .correction = 0.1,
     .near = 0.03,
     .margin = 0.05,
     .rest_iterations = 0.15,
     .steps = 45,
     .creep_to = 0.85,
     .done_before = 0.4,
     .done_after = 0.6},
    // Half steps: shortened to a quarter at once, they would leave motions that take many short
    // steps to die.
    {.name = "slow",
     .step = 0.5,
     .inertia = Inertia::damped,
     .correction = 0.1,
     .near = 0.015,
     .margin = 0.05,
     .rest_iterations = 0.25,
     .steps = 85,
     .creep_to = 1.0,
     .done_before = 0.6,
     .done_after = 0.78},
    // Quarter steps without momentum, solved half as well as the quench: what still moves is slowed
    // down.
    {.name = "halt",
     .step = 0.25,
     .correction = 0.5,
     .near = 0.015,
     .margin = 0.05,
     .rest_iterations = 0.5,
     .steps = 15,
     .done_before = 0.78,
     .done_after = 0.84},
    // Half steps without momentum: contacts close. Quarter steps take seven times as many for it,
    // full ones do not end.
    {.name = "close",
     .step = 0.5,
     .correction = 0.5,
     .near = 0.015,
     .margin = 0.05,
     .rest_iterations = 1.0,
     .steps = 40,
     .done_before = 0.84,
     .done_after = 0.92},
    // Quarter steps without momentum, until every test of rest holds.
    {.name = "quench",
     .end = StageEnd::rest,
     .step = 0.25,
     .correction = 0.5,
     .near = 0.015,
     .margin = 0.05,
     .rest_iterations = 1.0,
     .steps = 8,
     .most_steps = 1000,
     .usual_steps = 24,
     .done_before = 0.92,
     .done_after = 1.0},
};

/// Undamped short steps, until impacts alone have taken the energy; then the quench.
constexpr StageRule dynamic_turning[] = {
    turning[0],
    {.name = "fall",
     .end = StageEnd::halted,
     .step = 0.25,
     .inertia = Inertia::full,
     .path = 0.25,
     .sleeps = true,
     .near = 0.05,
     .margin = 0.05,
     .fall_iterations = 1.0,
     .steps = 1,
     .energy = 1e-2,
     .usual_steps = 1200,
     .done_after = 0.85},
    turning[6],
};

/// While a step leaves more, its iterations are doubled. A heavy grain on a light one needs more
/// sweeps than a bed, or the light one is pressed out from under it; grains of one size leave a
/// tenth of this in the middle of their fall. A mass times d.
constexpr double residual_cap = 0.01;
constexpr int iteration_cap = 20'000;  // enough for masses 1e6 to 1

/// At rest no more may be left than the rest test lets pass. Where f32 stops short of it, more
/// iterations seldom help: rounding has been reached, or will be in the next step.
int doublings_at_rest(Precision precision) { return precision == Precision::f64 ? 4 : 1; }

/// How far contacts may stray in a full step, d. A bed of half the step takes twice as many.
double path_tolerance(const Accuracy& accuracy) {
  return accuracy.path_tolerance * accuracy.step / Accuracy{}.step;
}

int iterations_of(const Accuracy& accuracy, const StageRule& rule) {
  return std::max(1,
                  static_cast<int>(std::lround(rule.fall_iterations * accuracy.fall_iterations +
                                               rule.rest_iterations * accuracy.rest_iterations)));
}

double momentum_of(const Accuracy& accuracy, Inertia inertia) {
  return inertia == Inertia::none ? 0.0 : inertia == Inertia::damped ? accuracy.momentum : 1.0;
}

/// Steps of a share of the creep. Shorter steps are more, so that the creep takes as long.
std::int64_t creep_steps(const Accuracy& accuracy, double share) {
  constexpr double rounding = 1e-9;
  const double steps = accuracy.creep_steps * (Accuracy{}.step / accuracy.step);
  return static_cast<std::int64_t>(std::floor(share * steps + rounding));
}

}  // namespace

template <>
Stages stages_of<Sphere>(Protocol protocol) {
  return protocol == Protocol::dynamic ? Stages(dynamic) : Stages(heavy_ball);
}

template <>
Stages stages_of<Polyhedron>(Protocol protocol) {
  return protocol == Protocol::dynamic ? Stages(dynamic_turning) : Stages(turning);
}

StepSettings settings_of(const Accuracy& accuracy, const StageRule& rule) {
  StepSettings s;
  s.dt = rule.step * accuracy.step;
  s.momentum = momentum_of(accuracy, rule.inertia);
  s.correction = rule.correction;
  s.near = rule.near;
  s.margin = rule.margin;
  s.limits = {accuracy.solver, iterations_of(accuracy, rule), accuracy.residual_tolerance / 5.0};
  s.limits.rms_tolerance = rule.path * path_tolerance(accuracy) / (s.dt * s.dt);
  s.limits.residual_cap = residual_cap;
  s.limits.iteration_cap = iteration_cap;
  if (rule.end == StageEnd::rest) {
    s.limits.residual_cap = std::min(residual_cap, accuracy.residual_tolerance * s.dt * s.dt);
    s.limits.iteration_cap =
        std::min(iteration_cap, s.limits.iterations << doublings_at_rest(accuracy.precision));
  }
  return s;
}

std::int64_t steps_of(const Accuracy& accuracy, const StageRule& rule) {
  return rule.steps + creep_steps(accuracy, rule.creep_to);
}

double share_done(const Accuracy& accuracy, const StageRule& rule, std::int64_t steps_in_stage) {
  const std::int64_t usual =
      std::max<std::int64_t>(1, rule.usual_steps > 0 ? rule.usual_steps : steps_of(accuracy, rule));
  const double in_stage = static_cast<double>(steps_in_stage) / static_cast<double>(usual);
  return rule.done_before + (rule.done_after - rule.done_before) * in_stage / (1.0 + in_stage);
}

}  // namespace grainsweep
