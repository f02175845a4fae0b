#include "engine/dynamics/stages.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

using enum StageEnd;
constexpr Inertia none = Inertia::none, damped = Inertia::damped, full = Inertia::full;
constexpr double two_thirds = 2.0 / 3.0;

// An impact has a kinetic energy of about 0.2 m g d; grains that turn go on rattling at a few 1e-3.
// Contacts go on closing for about as many steps as a quench has at least.
constexpr StageRule heavy_ball[] = {
    {look, 0.5, none, 1.0, 0.01, 0.01, 0.0, 2.0, 8, 0.0, 0.0, 8, 0.0, 0.0},
    {fallen, 1.0, damped, 0.1, 0.08, 0.01, 1.0, 0.0, 1, 0.0, 0.0, 160, 0.0, 0.3, 5e-3},
    {steps, 2.0, damped, 0.3, 0.05, 0.01, 0.0, 0.5, 0, 0.0, two_thirds, 0, 0.3,
     0.5},  // loose creep
    {steps, 2.0, damped, 0.3, 0.05, 0.01, 0.0, 1.0, 0, two_thirds, 1.0, 0, 0.5, 0.75},
    {steps, 1.0, none, 1.0, 0.02, 0.01, 0.0, 2.0, 6, 0.0, 0.0, 6, 0.75, 0.85},
    {rest, 0.5, none, 1.0, 0.01, 0.01, 0.0, 2.0, 8, 0.0, 0.0, 12, 0.85, 1.0},
};
constexpr StageRule dynamic[] = {
    heavy_ball[0],
    {halted, 0.25, full, 0.0, 0.08, 0.05, 1.0, 0.0, 1, 0.0, 0.0, 1200, 0.0, 0.85, 5e-3},
    heavy_ball[5],
};
constexpr StageRule turning[] = {
    {look, 0.25, none, 0.5, 0.03, 0.05, 0.0, 1.0, 8, 0.0, 0.0, 8, 0.0, 0.0},
    {fallen, 1.0, damped, 0.2, 0.05, 0.05, two_thirds, 0.0, 1, 0.0, 0.0, 110, 0.0, 0.2, 1e-2},
    {steps, 1.0, damped, 0.1, 0.03, 0.05, 1.0, 0.0, 45, 0.0, 0.85, 0, 0.2, 0.4},
    {steps, 0.5, damped, 0.1, 0.015, 0.05, two_thirds, 0.15, 85, 0.0, 1.0, 0, 0.4, 0.78},
    {steps, 0.25, none, 0.5, 0.015, 0.05, 0.0, 0.5, 15, 0.0, 0.0, 0, 0.78, 0.84},
    {rest, 0.25, none, 0.5, 0.015, 0.05, 0.0, 1.0, 20, 0.0, 0.0, 24, 0.84, 1.0},
};

/// Grains of one size leave a tenth of it in the middle of their fall. A heavy grain on a light one
/// needs more sweeps than a bed, or the light one is pressed out from under it. A mass times d.
constexpr double bearable_residual = 0.01;
constexpr int most_patience = 20'000;  // enough for masses 1e6 to 1

/// At rest no more is bearable than the rest test lets pass. Where f32 stops short of it, more
/// iterations seldom help: rounding has been reached, or will be in the next step.
int doublings_at_rest(Precision precision) { return precision == Precision::f64 ? 4 : 1; }

int iterations_of(const Accuracy& accuracy, const StageRule& rule) {
  return std::max(1, static_cast<int>(std::lround(rule.of_fall * accuracy.fall_iterations +
                                                  rule.of_rest * accuracy.rest_iterations)));
}

double momentum_of(const Accuracy& accuracy, Inertia inertia) {
  return inertia == none ? 0.0 : inertia == damped ? accuracy.momentum : 1.0;
}

/// Step of the creep at which a share of it is over; shares of thirds have rounding errors.
std::int64_t creep_step(const Accuracy& accuracy, double share) {
  constexpr double rounding = 1e-9;
  return static_cast<std::int64_t>(std::floor(share * accuracy.creep_steps + rounding));
}

}  // namespace

Stages stages_of_spheres(Protocol protocol) {
  return protocol == Protocol::dynamic ? Stages(dynamic) : Stages(heavy_ball);
}

Stages stages_of_shapes() { return turning; }

StepSettings settings_of(const Accuracy& accuracy, const StageRule& rule) {
  StepSettings s;
  s.dt = rule.step * accuracy.step;
  s.momentum = momentum_of(accuracy, rule.inertia);
  s.correction = rule.correction;
  s.near = rule.near;
  s.margin = rule.margin;
  s.limits = {accuracy.solver, iterations_of(accuracy, rule), accuracy.residual_tolerance / 5.0};
  s.limits.bearable = bearable_residual;
  s.limits.patience = most_patience;
  if (rule.end == rest) {
    s.limits.bearable = std::min(bearable_residual, accuracy.residual_tolerance * s.dt * s.dt);
    s.limits.patience =
        std::min(most_patience, s.limits.iterations << doublings_at_rest(accuracy.precision));
  }
  return s;
}

std::int64_t steps_of(const Accuracy& accuracy, const StageRule& rule) {
  return rule.least_steps + creep_step(accuracy, rule.creep_end) -
         creep_step(accuracy, rule.creep_begin);
}

double share_done(const Accuracy& accuracy, const StageRule& rule, std::int64_t steps_in_stage) {
  const std::int64_t usual =
      std::max<std::int64_t>(1, rule.usual_steps > 0 ? rule.usual_steps : steps_of(accuracy, rule));
  const double in_stage = static_cast<double>(steps_in_stage) / static_cast<double>(usual);
  return rule.usual_begin + (rule.usual_end - rule.usual_begin) * in_stage / (1.0 + in_stage);
}

}  // namespace grainsweep
