#include "engine/dynamics/shape_settle.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/contact/constraints.hpp"

namespace grainsweep {

namespace {

// The fall ends when the floor carries the bed and the bed has lost its speed; turning grains go on
// rattling at a few 1e-3.
constexpr double carried_share = 0.9;
constexpr double fall_energy = 1e-2;  // m g d per grain; an impact has about 0.2

enum class ShapeStage { fall, creep, slow, quench, rest };

/// What a stage changes in a step.
struct ShapeStageRule {
  double step;        ///< in steps of the fall
  double momentum;    ///< in those of the accuracy
  double correction;  ///< share of an overlap that a step repairs
  double near;        ///< contacts with a smaller gap are rows, d
  double iterations;  ///< most iterations a step, in rest_iterations; 0: those of the fall
  int steps;          ///< least number of steps; 0: twice the creep_steps
  double share_done;  ///< share of the work that is usually done before it
};

constexpr double search_margin = 0.05;  // candidates reach this much further, d

constexpr ShapeStageRule rules[] = {
    {1.0, 1.0, 0.2, 0.05, 0.0, 1, 0.0},
    {1.0, 1.0, 0.1, 0.03, 0.2, 0, 0.35},
    {0.5, 1.0, 0.1, 0.03, 2.0 / 3.0, 40, 0.6},
    {0.25, 0.0, 0.5, 0.03, 4.0 / 3.0, 40, 0.8},
};

const ShapeStageRule& rule(ShapeStage stage) { return rules[static_cast<std::size_t>(stage)]; }

StepSettings settings_of(const Accuracy& accuracy, ShapeStage stage) {
  const ShapeStageRule& r = rule(stage);
  const int iterations =
      r.iterations == 0.0
          ? accuracy.fall_iterations
          : std::max(1, static_cast<int>(std::lround(r.iterations * accuracy.rest_iterations)));
  StepSettings s;
  s.dt = r.step * accuracy.step;
  s.momentum = r.momentum * accuracy.momentum;
  s.correction = r.correction;
  s.near = r.near;
  s.margin = search_margin;
  s.limits = {accuracy.solver, iterations, accuracy.residual_tolerance / 5.0};
  return s;
}

int steps_of(const Accuracy& accuracy, ShapeStage stage) {
  const int steps = rule(stage).steps;
  return steps > 0 ? steps : 2 * accuracy.creep_steps;
}

/// Force of all points of contact k together, m g.
template <class Real>
double contact_force(const ShapeStepState<Real>& state, std::size_t k, double dt) {
  double sum = 0.0;
  for (std::size_t j = 0; j < state.contacts.contacts[k].count; ++j) {
    sum += impulse_of(state, k, j) / (dt * dt);
  }
  return sum;
}

/// Force of each contact that bears one, m g, by its two sides.
using ContactForces = std::map<std::pair<std::int32_t, std::int32_t>, double>;

template <class Real>
ContactForces contact_forces(const ShapeStepState<Real>& state, double dt) {
  ContactForces forces;
  for (std::size_t k = 0; k < state.contacts.contacts.size(); ++k) {
    const ShapeContact& c = state.contacts.contacts[k];
    const double force = contact_force(state, k, dt);
    if (force > least_force) forces.emplace(std::pair(c.a, c.b), force);
  }
  return forces;
}

/// What slides freely: see `certify`.
std::int64_t zero_modes(const ShapeBed& bed, const ContactForces& forces) {
  std::vector<char> held(bed.grains(), 0), stands(bed.grains(), 0);
  for (const auto& [sides, force] : forces) {
    (sides.second == bed.wall(0) ? stands : held)[static_cast<std::size_t>(sides.first)] = 1;
    if (bed.is_grain(sides.second)) held[static_cast<std::size_t>(sides.second)] = 1;
  }
  std::int64_t lone = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) lone += stands[i] != 0 && held[i] == 0 ? 1 : 0;
  const bool has_cluster = std::find(held.begin(), held.end(), 1) != held.end();
  const int free_axes =
      (bed.box.x == Boundary::periodic ? 1 : 0) + (bed.box.y == Boundary::periodic ? 1 : 0);
  return 3 * lone + (has_cluster ? free_axes : 0);
}

double depth_of(const ShapeContacts& found, const ShapeContact& contact) {
  double depth = 0.0;
  for (std::size_t j = 0; j < contact.count; ++j) {
    depth = std::max(depth, -found.points[contact.first + j].gap);
  }
  return depth;
}

template <class Real>
struct ShapeSettling {
  const Accuracy& accuracy;
  const Processor& processor;
  ShapeBed& bed;
  ShapeStepState<Real> state;
  ShapeStage stage = ShapeStage::fall;
  int steps_in_stage = 0;
  StepSettings settings;
  StepReport last;
  SettleReport report;
};

template <class Real>
bool has_fallen(const ShapeSettling<Real>& s) {
  double weight = 0.0, carried = 0.0;
  for (const Record<double>& motion : s.bed.motion) weight += 1.0 / motion.w;
  for (std::size_t k = 0; k < s.state.contacts.contacts.size(); ++k) {
    const bool of_floor = s.state.contacts.contacts[k].b == s.bed.wall(0);
    carried += of_floor ? contact_force(s.state, k, s.settings.dt) : 0.0;
  }
  return s.last.kinetic_energy < fall_energy && carried >= carried_share * weight;
}

template <class Real>
void certify_rest(ShapeSettling<Real>& s) {
  s.report.rest = certify(s.bed, s.processor, s.settings.dt, s.state);
  s.report.rest.residual = s.last.solve.residual;
  s.report.rest.kinetic_energy = s.last.kinetic_energy;
  s.report.rest.largest_motion = s.last.largest_motion;
  s.report.why_not = why_not_at_rest(s.report.rest, s.accuracy);
}

template <class Real>
bool is_over(ShapeSettling<Real>& s) {
  if (s.steps_in_stage < steps_of(s.accuracy, s.stage)) return false;
  if (s.stage == ShapeStage::fall) return has_fallen(s);
  if (s.stage != ShapeStage::quench) return true;
  certify_rest(s);
  return s.report.why_not.empty();
}

template <class Real>
void enter_next(ShapeSettling<Real>& s) {
  s.stage = static_cast<ShapeStage>(static_cast<int>(s.stage) + 1);
  s.steps_in_stage = 0;
  if (s.stage == ShapeStage::rest) return;
  const StepSettings next = settings_of(s.accuracy, s.stage);
  change_step(next.dt / s.settings.dt, s.bed, s.state);
  s.settings = next;
}

/// An estimate for progress bars that never falls.
template <class Real>
double share_done(const ShapeSettling<Real>& s) {
  const std::size_t next = static_cast<std::size_t>(s.stage) + 1;
  const double begin = rule(s.stage).share_done;
  const double end = next < std::size(rules) ? rules[next].share_done : 1.0;
  const double in_stage = s.steps_in_stage / (40.0 + s.steps_in_stage);
  return begin + (end - begin) * in_stage;
}

template <class Real>
bool take_step(ShapeSettling<Real>& s, const KeepGoing& keep_going) {
  s.last = step(s.settings, s.processor, s.bed, s.state);
  ++s.report.steps;
  ++s.steps_in_stage;
  s.report.iterations += s.last.solve.iterations;
  return keep_going({s.report.steps, share_done(s)});
}

/// Forces on grains and between them.
template <class Real>
void report_forces(ShapeSettling<Real>& s) {
  s.report.force.assign(s.bed.grains(), 0.0);
  for (const auto& [sides, force] : contact_forces(s.state, s.settings.dt)) {
    const auto a = static_cast<std::size_t>(sides.first),
               b = static_cast<std::size_t>(sides.second);
    s.report.force[a] += force;
    if (!s.bed.is_grain(sides.second)) continue;
    s.report.force[b] += force;
    const double height = (s.bed.centre[a].z + s.bed.centre[b].z) / 2.0;
    s.report.pair_forces.push_back({sides.first, sides.second, height, force});
  }
}

template <class Real>
SettleReport settle_as(const Accuracy& accuracy, const Processor& processor, ShapeBed& bed,
                       const KeepGoing& keep_going) {
  ShapeSettling<Real> s{
      accuracy, processor, bed, {}, ShapeStage::fall, 0, settings_of(accuracy, ShapeStage::fall),
      {},       {}};
  while (s.stage != ShapeStage::rest && s.report.steps < accuracy.max_steps &&
         !s.report.cancelled) {
    if (is_over(s)) {
      enter_next(s);
    } else {
      s.report.cancelled = !take_step(s, keep_going);
    }
  }
  if (s.stage != ShapeStage::rest) certify_rest(s);
  report_forces(s);
  return s.report;
}

}  // namespace

template <class Real>
RestReport certify(ShapeBed& bed, const Processor& processor, double dt,
                   ShapeStepState<Real>& state) {
  const ContactForces forces = contact_forces(state, dt);
  ShapeContacts now;
  find_contacts({touch_settings(constraint_gap, dt), search_margin}, processor, bed, state.search,
                now);
  RestReport rest;
  std::int64_t bearing = 0;
  for (const ShapeContact& c : now.contacts) {
    if (forces.find({c.a, c.b}) == forces.end()) continue;
    const double depth = depth_of(now, c);
    rest.overlap_mean += depth;
    rest.overlap_max = std::max(rest.overlap_max, depth);
    rest.contacts += constraints_of(now.points.data() + c.first, c.count, constraint_gap);
    ++bearing;
  }
  rest.overlap_mean /= static_cast<double>(std::max<std::int64_t>(bearing, 1));
  rest.isostatic_contacts = 6 * static_cast<std::int64_t>(bed.grains()) - zero_modes(bed, forces);
  return rest;
}

SettleReport settle(const Accuracy& accuracy, const Processor& processor, ShapeBed& bed,
                    const KeepGoing& keep_going) {
  return accuracy.precision == Precision::f32
             ? settle_as<float>(accuracy, processor, bed, keep_going)
             : settle_as<double>(accuracy, processor, bed, keep_going);
}

template RestReport certify(ShapeBed&, const Processor&, double, ShapeStepState<float>&);
template RestReport certify(ShapeBed&, const Processor&, double, ShapeStepState<double>&);

}  // namespace grainsweep
