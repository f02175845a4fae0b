#include "engine/dynamics/settle.hpp"

#include <cmath>

#include "engine/dynamics/balance.hpp"
#include "engine/dynamics/saved_state.hpp"
#include "engine/dynamics/stages.hpp"
#include "engine/dynamics/workspace.hpp"

namespace grainsweep {

namespace {

// The fall ends when the floor carries the bed and the bed has lost its speed.
constexpr double carried_share = 0.9;
constexpr double fall_energy = 5e-3;  // m g d per grain; an impact has about 0.2

/// Everything a settling bed carries from step to step.
template <class Real>
struct Settling {
  const Accuracy& accuracy;
  const Processor& processor;
  SphereBed& bed;
  StepState<Real>& state;
  Stage stage = Stage::look;
  std::int64_t steps_in_stage = 0;
  StepSettings settings;
  StepReport last;
  SettleReport report;
};

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
  s.report.rest = certify(s.bed, s.processor, s.settings.dt, s.state.contacts);
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

/// Whether the stage has done its work. Looks at the bed after at least one step.
template <class Real>
bool is_over(Settling<Real>& s) {
  const bool has_steps = s.steps_in_stage >= steps_of(s.accuracy, s.stage);
  switch (s.stage) {
    case Stage::look:  // a bed that is not carried is none, the first step tells
      return has_steps || (s.steps_in_stage > 0 && !is_carried(s));
    case Stage::fall:
      return has_steps && has_fallen(s);
    case Stage::dynamic_fall:
      return has_steps && has_fallen(s) && s.last.kinetic_energy < s.accuracy.kinetic_tolerance;
    case Stage::quench:
      return has_steps && is_at_rest(s);
    default:
      return has_steps;
  }
}

template <class Real>
Stage next_stage(Settling<Real>& s) {
  switch (s.stage) {
    case Stage::look:
      return is_carried(s) && is_at_rest(s)             ? Stage::rest
             : s.accuracy.protocol == Protocol::dynamic ? Stage::dynamic_fall
                                                        : Stage::fall;
    case Stage::fall:
      return Stage::loose_creep;
    case Stage::loose_creep:
      return Stage::creep;
    case Stage::creep:
      return Stage::halt;
    case Stage::halt:
    case Stage::dynamic_fall:
      return Stage::quench;
    case Stage::quench:
    case Stage::rest:
      break;
  }
  return Stage::rest;
}

/// Velocities stay as they are when the step changes: motions scale with dt, impulses with dt^2.
template <class Real>
void change_step(Settling<Real>& s, const StepSettings& settings) {
  const double ratio = settings.dt / s.settings.dt;
  s.settings = settings;
  s.state.has_candidates = false;
  for (Record<double>& motion : s.bed.motion) {
    motion.x *= ratio;
    motion.y *= ratio;
    motion.z *= ratio;
  }
  for (Real& impulse : s.state.contacts.impulse) {
    impulse *= static_cast<Real>(ratio * ratio);
  }
}

template <class Real>
void enter(Stage stage, Settling<Real>& s) {
  s.stage = stage;
  s.steps_in_stage = 0;
  if (stage != Stage::rest) {
    change_step(s, settings_of(s.accuracy, stage));
  }
}

template <class Archive, class List>
void transfer_candidates(Archive& archive, List& candidates) {
  archive.value(candidates.reach);
  archive.value(candidates.largest_radius);
  archive.column(candidates.pairs);
  archive.column(candidates.built_at);
  archive.column(candidates.layer);
  archive.column(candidates.layers);
  archive.list(candidates.walls, [&](auto& near) {
    archive.value(near.wall);
    archive.column(near.grains);
  });
}

template <class Archive, class Rows>
void transfer_contacts(Archive& archive, Rows& contacts) {
  archive.column(contacts.rows);
  archive.value(contacts.pair_blocks);
  archive.column(contacts.walls);
  archive.column(contacts.ranges);
  archive.column(contacts.impulse);
}

/// Lists what a packing needs to go on; settings follow from the stage.
template <class Archive, class State>
void transfer(Archive& archive, State& s) {
  archive.value(s.stage);
  archive.value(s.steps_in_stage);
  archive.value(s.last);
  archive.value(s.report.steps);
  archive.value(s.report.iterations);
  archive.column(s.bed.position);
  archive.column(s.bed.motion);
  archive.value(s.state.has_candidates);
  transfer_candidates(archive, s.state.candidates);
  transfer_contacts(archive, s.state.contacts);
}

/// States of other number types and other beds are of another kind.
template <class Real>
std::uint64_t kind_of(const Settling<Real>& s) {
  return s.bed.grains() * 16 + sizeof(Real);
}

template <class Real>
std::string saved(const Settling<Real>& s) {
  StateWriter writer;
  transfer(writer, s);
  return sealed(kind_of(s), writer.bytes());
}

template <class Real>
void restore(std::string_view bytes, Settling<Real>& s) {
  if (const auto payload = unsealed(kind_of(s), bytes)) {
    StateReader reader(*payload);
    transfer(reader, s);
    s.settings = settings_of(s.accuracy, s.stage);
  }
}

/// One step; false if the observer does not want another one.
template <class Real>
bool take_step(Settling<Real>& s, const KeepGoing& keep_going) {
  s.last = step(s.settings, s.processor, s.bed, s.state);
  ++s.report.steps;
  ++s.steps_in_stage;
  s.report.iterations += s.last.solve.iterations;
  const double share = share_done(s.accuracy, s.stage, s.steps_in_stage - 1);
  return keep_going({s.report.steps, share, [&s] { return saved(s); }});
}

/// Whether there is another step to take. A state that is not finite must not be searched: it lies
/// in no cell.
template <class Real>
bool goes_on(const Settling<Real>& s) {
  return s.stage != Stage::rest && s.report.steps < s.accuracy.max_steps && !s.report.cancelled &&
         std::isfinite(s.last.kinetic_energy);
}

/// Stage after stage, until the bed rests, the steps run out or the observer stops it.
template <class Real>
void come_to_rest(Settling<Real>& s, const KeepGoing& keep_going) {
  while (goes_on(s)) {
    if (is_over(s)) {
      enter(next_stage(s), s);
    } else {
      s.report.cancelled = !take_step(s, keep_going);
    }
  }
}

template <class Real>
SettleReport settle_as(const Accuracy& accuracy, const Processor& processor, SphereBed& bed,
                       const KeepGoing& keep_going, std::string_view saved) {
  Workspace own;
  StepState<Real>& state =
      step_state<Real>(processor.workspace != nullptr ? *processor.workspace : own);
  forget(state);
  Settling<Real> s{
      accuracy, processor, bed, state, Stage::look, 0, settings_of(accuracy, Stage::look), {}, {}};
  restore(saved, s);
  come_to_rest(s, keep_going);
  certify_rest(s);
  if (accuracy.force_balance == BalanceCheck::solve && !s.report.cancelled) {
    s.report.balance = balance_forces(bed, processor.kernels, s.settings.dt, s.state.contacts);
  }
  s.report.force = force_sums(bed, s.state.contacts, s.settings.dt);
  s.report.pair_forces = pair_forces(bed, s.state.contacts, s.settings.dt);
  return s.report;
}

}  // namespace

SettleReport settle(const Accuracy& accuracy, const Processor& processor, SphereBed& bed,
                    const KeepGoing& keep_going, std::string_view saved) {
  return accuracy.precision == Precision::f32
             ? settle_as<float>(accuracy, processor, bed, keep_going, saved)
             : settle_as<double>(accuracy, processor, bed, keep_going, saved);
}

}  // namespace grainsweep
