#include "engine/dynamics/stages.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

/// What a step takes over from the motion of the last one.
enum class Inertia { none, damped, full };

/// What a stage changes in a step. Motions and overlaps go with the square of a step, so that
/// shorter steps need to look less far.
struct StageRule {
  double step;  ///< in steps of the fall
  Inertia inertia;
  double correction;   ///< share of an overlap that a step repairs
  double near;         ///< pairs with a smaller gap are rows, d
  double margin;       ///< candidates reach this much further, d
  double iterations;   ///< most iterations a step, in rest_iterations; 0: those of the fall
  double usual_begin;  ///< share of the work that is usually done before it and after it
  double usual_end;
  std::int64_t usual_steps;  ///< the creep's are in the accuracy
};

constexpr StageRule rules[] = {
    {0.5, Inertia::none, 1.0, 0.01, 0.01, 2.0, 0.0, 0.0, 8},       // look: quench as it is
    {1.0, Inertia::damped, 0.1, 0.08, 0.01, 0.0, 0.0, 0.3, 160},   // fall
    {0.25, Inertia::full, 0.0, 0.08, 0.05, 0.0, 0.0, 0.85, 1200},  // dynamic fall
    {2.0, Inertia::damped, 0.3, 0.05, 0.01, 0.5, 0.3, 0.5, 0},     // loose creep
    {2.0, Inertia::damped, 0.3, 0.05, 0.01, 1.0, 0.5, 0.75, 0},    // creep
    {1.0, Inertia::none, 1.0, 0.02, 0.01, 2.0, 0.75, 0.85, 6},     // halt
    {0.5, Inertia::none, 1.0, 0.01, 0.01, 2.0, 0.85, 1.0, 12},     // quench
};

const StageRule& rule(Stage stage) { return rules[static_cast<std::size_t>(stage)]; }

int iterations_of(const Accuracy& accuracy, const StageRule& r) {
  return r.iterations == 0.0
             ? accuracy.fall_iterations
             : std::max(1, static_cast<int>(std::lround(r.iterations * accuracy.rest_iterations)));
}

double momentum_of(const Accuracy& accuracy, Inertia inertia) {
  return inertia == Inertia::none ? 0.0 : inertia == Inertia::damped ? accuracy.momentum : 1.0;
}

std::int64_t loose_creep_steps(const Accuracy& accuracy) { return 2 * accuracy.creep_steps / 3; }

double usual_steps(const Accuracy& accuracy, Stage stage) {
  const std::int64_t usual = rule(stage).usual_steps;
  return static_cast<double>(
      std::max<std::int64_t>(1, usual > 0 ? usual : steps_of(accuracy, stage)));
}

}  // namespace

StepSettings settings_of(const Accuracy& accuracy, Stage stage) {
  const StageRule& r = rule(stage);
  StepSettings s;
  s.dt = r.step * accuracy.step;
  s.momentum = momentum_of(accuracy, r.inertia);
  s.correction = r.correction;
  s.near = r.near;
  s.margin = r.margin;
  s.limits = {accuracy.solver, iterations_of(accuracy, r), accuracy.residual_tolerance / 5.0};
  return s;
}

std::int64_t steps_of(const Accuracy& accuracy, Stage stage) {
  constexpr std::int64_t least_quench = 8;  // contacts go on closing for about as many
  switch (stage) {
    case Stage::look:
    case Stage::quench:
      return least_quench;
    case Stage::loose_creep:
      return loose_creep_steps(accuracy);
    case Stage::creep:
      return accuracy.creep_steps - loose_creep_steps(accuracy);
    case Stage::halt:
      return rule(stage).usual_steps;
    case Stage::fall:
    case Stage::dynamic_fall:
      return 1;
    case Stage::rest:
      break;
  }
  return 0;
}

double share_done(const Accuracy& accuracy, Stage stage, std::int64_t steps_in_stage) {
  const StageRule& r = rule(stage);
  const double in_stage = static_cast<double>(steps_in_stage) / usual_steps(accuracy, stage);
  return r.usual_begin + (r.usual_end - r.usual_begin) * in_stage / (1.0 + in_stage);
}

}  // namespace grainsweep
