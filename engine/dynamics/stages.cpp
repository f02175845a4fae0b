#include "engine/dynamics/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/dynamics/inertia.hpp"

namespace grainsweep {

namespace {

// ---- spheres ----

/// A bed that is already at rest stays as it is: some steps of the quench show that, as many as it
/// takes to find its forces from none, or up to four times as many if what they leave is only a
/// little too much.
constexpr StageRule look = {.name = "look",
                            .end = StageEnd::look,
                            .step = 0.5,
                            .carries = true,
                            .correction = 1.0,
                            .near = 0.01,
                            .margin = 0.01,
                            .rest_iterations = 2.0,
                            .steps = 40,
                            .usual_steps = 40};

/// Steps with momentum until the floor carries the bed. Overlaps are repaired slowly, so that loose
/// solves do not throw grains about. An impact has a kinetic energy of about 0.2 m g d.
constexpr StageRule fall = {.name = "fall",
                            .end = StageEnd::fallen,
                            .inertia = Inertia::damped,
                            .path = 2.0,
                            .sleeps = true,
                            .longest_free = 0.3,
                            .correction = 0.1,
                            .near = 0.1,
                            .margin = 0.01,
                            .fall_iterations = 1.0,
                            .steps = 1,
                            .energy = 5e-3,
                            .usual_steps = 90,
                            .done_after = 0.25};

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
                                    .done_after = 0.25};

/// Short steps with momentum, solved to a path: grains slide into their places. How far a bed still
/// sinks depends on the number of its steps, little on their length or momentum; how much it is
/// tapped depends on the path of all of them: a hundredth of that. In a step 0.6 times as long a
/// residual force moves a grain 0.36 times as far, so that fewer sweeps keep to the same path: a
/// quarter more of such steps cost less and sink the bed further.
constexpr StageRule creep = {.name = "creep",
                             .step = 0.6,
                             .by_depth = true,
                             .inertia = Inertia::damped,
                             .path_of_creep = 160.0,
                             .carries = true,
                             .correction = 0.3,
                             .near = 0.03,
                             .margin = 0.01,
                             .fall_iterations = 1.0,
                             .creep = 1.25,
                             .done_before = 0.25,
                             .done_after = 0.5};

/// Half steps: contacts close.
constexpr StageRule slow = {.name = "slow",
                            .step = 0.5,
                            .by_depth = true,
                            .inertia = Inertia::damped,
                            .path_of_creep = 4.0,
                            .carries = true,
                            .correction = 0.5,
                            .near = 0.03,
                            .margin = 0.01,
                            .fall_iterations = 1.0,
                            .creep = 0.1,
                            .done_before = 0.5,
                            .done_after = 0.6};

/// Quarter steps with momentum that stray by far less than the gaps that count, so that nothing but
/// the forces that no contact balances moves the bed: it slides on until it meets new contacts, and
/// is calm. Beds that are quenched while they still slide fail its tests, and few do once they are
/// calm.
constexpr StageRule ease = {.name = "ease",
                            .end = StageEnd::calm,
                            .step = 0.25,
                            .by_depth = true,
                            .inertia = Inertia::damped,
                            .path_of_gap = 0.1,
                            .carries = true,
                            .correction = 0.5,
                            .near = 0.02,
                            .margin = 0.01,
                            .fall_iterations = 1.0,
                            .steps = 40,
                            .most_steps = 400,
                            .usual_steps = 60,
                            .done_before = 0.6,
                            .done_after = 0.8};

/// Half steps without momentum: gaps close to far below those that count, and the bed is tested.
/// One that fails eases on. More such steps close more of the gaps that count (bench/tried.md,
/// Quench): a longer creep has more of them.
constexpr StageRule quench = {.name = "quench",
                              .end = StageEnd::rest,
                              .step = 0.5,
                              .carries = true,
                              .correction = 1.0,
                              .near = 0.01,
                              .margin = 0.01,
                              .rest_iterations = 2.0,
                              .creep = 1.0 / 24.0,
                              .most_steps = 1000,
                              .done_before = 0.8,
                              .done_after = 1.0};

constexpr StageRule heavy_ball[] = {look, fall, creep, slow, ease, quench};

/// The same stages with another fall, which comes second.
template <std::size_t stages>
constexpr std::array<StageRule, stages> with_fall(const StageRule& other,
                                                  const StageRule (&rules)[stages]) {
  std::array<StageRule, stages> changed = std::to_array(rules);
  changed[1] = other;
  return changed;
}

constexpr auto dynamic = with_fall(dynamic_fall, heavy_ball);

// ---- polyhedra ----

constexpr StageRule turning[] = {
    // As for spheres. Grains whose forces are not found sink, and open contacts, in a few steps.
    {.name = "look",
     .end = StageEnd::look,
     .step = 0.25,
     .correction = 0.5,
     .near = 0.03,
     .margin = 0.05,
     .rest_iterations = 1.0,
     .closer = 8,
     .steps = 8,
     .usual_steps = 8},
    // As for spheres. Polyhedra go on rattling at a few 1e-3 m g d.
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
    // Full steps in beds of up to 10 d.
    {.name = "creep",
     .by_depth = true,
     .inertia = Inertia::damped,
     .path_of_creep = 60.0,
     .correction = 0.1,
     .near = 0.03,
     .margin = 0.05,
     .steps_on_contacts = 2,
     .fall_iterations = 1.0,
     .steps = 20,
     .creep = 0.5,
     .done_before = 0.4,
     .done_after = 0.6},
    // Half steps: shortened to a quarter at once, they would leave motions that take many short
    // steps to die.
    {.name = "slow",
     .step = 0.5,
     .by_depth = true,
     .inertia = Inertia::damped,
     .path_of_creep = 22.5,
     .correction = 0.1,
     .near = 0.015,
     .margin = 0.05,
     .steps_on_contacts = 2,
     .fall_iterations = 1.0,
     .steps = 40,
     .creep = 0.75,
     .done_before = 0.6,
     .done_after = 0.78},
    // As for spheres. Flat and sharp grains may rock for long without being far from rest. Inertia
    // is mass again: steps shortened by depth would take more rounds to get there.
    {.name = "ease",
     .end = StageEnd::calm,
     .step = 0.25,
     .inertia = Inertia::damped,
     .path_of_gap = 0.1,
     .correction = 0.5,
     .near = 0.02,
     .margin = 0.05,
     .steps_on_contacts = 2,
     .fall_iterations = 1.0,
     .steps = 40,
     .most_steps = 80,
     .usual_steps = 60,
     .done_before = 0.78,
     .done_after = 0.92},
    // Quarter steps without momentum, until every test of rest holds: half steps would not end.
    {.name = "quench",
     .end = StageEnd::rest,
     .step = 0.25,
     .correction = 0.5,
     .near = 0.015,
     .margin = 0.05,
     .steps_on_contacts = 2,
     .rest_iterations = 1.0,
     .steps = 40,
     .most_steps = 1000,
     .usual_steps = 40,
     .done_before = 0.92,
     .done_after = 1.0},
};

/// As that of spheres.
constexpr StageRule dynamic_turning_fall = [] {
  StageRule fall_of_polyhedra = dynamic_fall;
  fall_of_polyhedra.near = 0.05;
  fall_of_polyhedra.energy = 1e-2;
  fall_of_polyhedra.done_after = 0.4;
  return fall_of_polyhedra;
}();

constexpr auto dynamic_turning = with_fall(dynamic_turning_fall, turning);

/// While a step leaves a larger residual, its iterations are doubled. A heavy grain on a light one
/// needs more sweeps than a usual bed, or the light one is pressed out from under it; grains of one
/// size leave a tenth of this in the middle of their fall. A mass times d.
constexpr double residual_cap = 0.01;
constexpr int iteration_cap = 20'000;  // enough for masses 1e6 to 1

/// At rest the residual may be no larger than the test of rest allows. Where f32 does not get
/// there, more iterations seldom help: rounding has been reached, or will be in the next step.
int doublings_at_rest(Precision precision) { return precision == Precision::f64 ? 4 : 1; }

/// How far contacts may stray in a full step, d. With half the step a bed takes twice as many
/// steps.
double path_tolerance(const Accuracy& accuracy) {
  return accuracy.path_tolerance * accuracy.step / Accuracy{}.step;
}

/// How far contacts may stray in a step of a stage that has such a bound, d. The steps of a creep
/// share one bound, so that a longer creep does not tap the bed denser; where few steps are asked
/// for, so do the least steps that a creep of polyhedra has.
double path_of(const Accuracy& accuracy, const StageRule& rule) {
  const double steps =
      std::max({1.0, static_cast<double>(rule.steps), rule.creep * accuracy.creep_steps});
  return (rule.path + rule.path_of_creep / steps) * path_tolerance(accuracy);
}

/// At rest forces are passed on from the surface to the floor, from grain to grain: a bed higher
/// than 27 mean diameters needs more sweeps than the 40 of `fast`. With those 40 a bed of 65 d does
/// not rest and slides on, five to ten times as long as it takes with 100; so does one of 13 d in
/// which most grains are a fifth as large as the others.
constexpr double sweeps_of_a_layer = 1.5;

double step_of(const Accuracy& accuracy, const StageRule& rule, double height) {
  return (rule.by_depth ? shortened_step(height) : 1.0) * rule.step * accuracy.step;
}

int iterations_of(const Accuracy& accuracy, const StageRule& rule, double layers) {
  const double at_rest =
      std::max(static_cast<double>(accuracy.rest_iterations), sweeps_of_a_layer * layers);
  return std::max(1, static_cast<int>(std::lround(rule.fall_iterations * accuracy.fall_iterations +
                                                  rule.rest_iterations * at_rest)));
}

double momentum_of(const Accuracy& accuracy, Inertia inertia) {
  return inertia == Inertia::none ? 0.0 : inertia == Inertia::damped ? accuracy.momentum : 1.0;
}

/// Steps of a share of the creep. Shorter steps are more in number, so that the creep takes as
/// long.
std::int64_t creep_steps(const Accuracy& accuracy, double share) {
  constexpr double rounding = 1e-9;
  const double steps = accuracy.creep_steps * (Accuracy{}.step / accuracy.step);
  return static_cast<std::int64_t>(std::floor(share * steps + rounding));
}

// In d: walls further apart than this order grains no more than far ones do, nor do images of a
// grain in a periodic box.
constexpr double far_walls = 5.0, far_all_around = 7.0, far_images = 5.0;

}  // namespace

template <>
Stages stages_of<Sphere>(Protocol protocol) {
  return protocol == Protocol::dynamic ? Stages(dynamic) : Stages(heavy_ball);
}

template <>
Stages stages_of<Polyhedron>(Protocol protocol) {
  return protocol == Protocol::dynamic ? Stages(dynamic_turning) : Stages(turning);
}

Accuracy closer_where_narrow(const Accuracy& accuracy, const Box& box) {
  const double far = is_walled_around(box) ? far_all_around : far_walls;
  const double apart = std::min({1.0, nearest_walls(box) / far, shortest_period(box) / far_images});
  Accuracy closer = accuracy;
  closer.path_tolerance *= apart * apart;
  return closer;
}

double calm_motion(const Accuracy& accuracy, const StageRule& rule) {
  const double dt = rule.step * accuracy.step;
  return accuracy.imbalance_tolerance * dt * dt / (1.0 - accuracy.momentum);
}

StepSettings settings_of(const Accuracy& accuracy, const StageRule& rule, double height,
                         double layers) {
  StepSettings s;
  s.dt = step_of(accuracy, rule, height);
  s.momentum = momentum_of(accuracy, rule.inertia);
  s.correction = rule.correction;
  s.near = rule.near;
  s.margin = rule.margin;
  s.longest_free = rule.longest_free;
  s.carries = rule.carries;
  s.steps = rule.steps_on_contacts;
  s.limits = {accuracy.solver, iterations_of(accuracy, rule, layers),
              accuracy.residual_tolerance / 5.0};
  const double path = path_of(accuracy, rule) + rule.path_of_gap * accuracy.imbalance_gap;
  s.limits.rms_tolerance = path / (s.dt * s.dt);
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
  return rule.steps + creep_steps(accuracy, rule.creep);
}

double share_done(const Accuracy& accuracy, const StageRule& rule, std::int64_t steps_in_stage) {
  const std::int64_t usual =
      std::max<std::int64_t>(1, rule.usual_steps > 0 ? rule.usual_steps : steps_of(accuracy, rule));
  const double in_stage = static_cast<double>(steps_in_stage) / static_cast<double>(usual);
  return rule.done_before + (rule.done_after - rule.done_before) * in_stage / (1.0 + in_stage);
}

}  // namespace grainsweep
