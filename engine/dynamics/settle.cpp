#include "engine/dynamics/settle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/dynamics/balance.hpp"
#include "engine/dynamics/changes.hpp"
#include "engine/dynamics/columns.hpp"
#include "engine/dynamics/rank.hpp"
#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/saved_beds.hpp"
#include "engine/dynamics/saved_state.hpp"
#include "engine/dynamics/sleep.hpp"
#include "engine/dynamics/stages.hpp"
#include "engine/dynamics/workspace.hpp"
#include "engine/exact/exact_rest.hpp"

namespace grainsweep {

namespace {

constexpr double carried_share = 0.9;      // of its weight, where the floor carries a bed
constexpr std::int64_t most_rounds = 32;   // a bed that needs more does not come to rest
constexpr std::int64_t most_unsolved = 9;  // of them in a row that leave forces unsolved
constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double rounding_of_places = 1e-9;  // d; far from the origin coordinates have fewer digits

/// Everything a settling bed carries from step to step.
template <class Kind, class Real>
struct Settling {
  const Accuracy& accuracy;
  const ExecutionContext& context;
  Bed<Kind>& bed;
  StepState<Kind, Real>& state;
  StepState<Kind, double>& closed;  ///< memory of the static balance
  Stages stages;
  std::size_t stage = 0;  ///< the number of stages when the bed is at rest
  std::int64_t steps_in_stage = 0;
  double height = 0.0;  ///< of the bed when the stage began, d
  StepSettings settings;
  StepReport last = {};
  double sunk_at_start = 0.0;  ///< StepReport::sunk of the first step
  double share_done = 0.0;     ///< the most that was told
  std::int64_t rounds = 0;     ///< how often the last stages came again
  std::int64_t unsolved = 0;   ///< so many of the last rounds ended with too large a residual
  std::int64_t iterations_before = 0;  ///< those until the bed was first tested for rest
  std::int64_t searches_failed = 0;    ///< of those for exact rest from a bed at rest in steps
  bool is_tested = false;              ///< whether the report tells how the bed rests as it is
  bool is_exact = false;               ///< whether the report is that of exact rest
  SettleReport report = {};

  const StageRule& rule() const { return stages[stage]; }
};

/// Steps of the stage that the bed is in.
template <class Kind, class Real>
StepSettings settings_of(const Settling<Kind, Real>& s) {
  return settings_of(s.accuracy, s.rule(), s.height);
}

/// Heaviest over lightest grain.
double mass_ratio(const Grains& bed) {
  double least = bed.motion.front().w, most = least;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    least = std::min(least, bed.motion[i].w);
    most = std::max(most, bed.motion[i].w);
  }
  return most / least;
}

bool is_fit(const Accuracy& accuracy, const Grains& bed) {
  return accuracy.precision == Precision::f64 || bed.grains() == 0 ||
         mass_ratio(bed) <= f32_mass_ratio;
}

/// See static_imbalance.
template <class Kind, class Real>
Imbalance imbalance_of(Settling<Kind, Real>& s, double of_interest) {
  return static_imbalance(s.accuracy.imbalance_gap, of_interest, s.context, s.bed, s.settings.dt,
                          s.state.contacts, s.closed);
}

// ---- stage after stage ----

template <class Kind, class Real>
bool is_carried(const Settling<Kind, Real>& s) {
  return s.last.carried > carried_share;
}

template <class Kind, class Real>
bool has_fallen(const Settling<Kind, Real>& s) {
  return s.last.kinetic_energy < s.rule().energy && is_carried(s);
}

/// Whether what is looked at may be a bed at rest, which the floor carries. The first step tells of
/// most; the forces of a high bed take some steps to get down to the floor.
template <class Kind, class Real>
bool is_bed(const Settling<Kind, Real>& s) {
  constexpr double enough_at_first = 0.3;
  constexpr std::int64_t steps_down = 4;
  return s.last.carried > (s.steps_in_stage < steps_down ? enough_at_first : carried_share);
}

/// Whether there are steps for going on: of beds that slide on before they are tested once more,
/// for both.
template <class Kind, class Real>
bool has_steps_to_go_on(const Settling<Kind, Real>& s) {
  const std::size_t last = s.stages.size() - 1, back = s.stages[last].back;
  if (back == 0) return s.report.steps < s.accuracy.max_steps;
  const std::int64_t round =
      steps_of(s.accuracy, s.stages[last]) + steps_of(s.accuracy, s.stages[last - back]);
  return s.report.steps + round <= s.accuracy.max_steps;
}

/// All tests of rest; that of the static balance, as dear as some steps, only of beds that pass the
/// others.
template <class Kind, class Real>
void test_rest(Settling<Kind, Real>& s) {
  s.is_tested = true;
  RestReport& rest = s.report.rest;
  rest = measure_rest(s.bed, s.context, s.settings.dt, s.state);
  rest.step_residual = s.last.solve.residual;
  rest.kinetic_energy = s.last.kinetic_energy;
  rest.largest_motion = s.last.largest_motion;
  const bool may_go_on = has_steps_to_go_on(s);
  s.report.failure = rest_failure(rest, s.accuracy, may_go_on);
  if (!s.report.failure.empty()) return;
  rest.imbalance = imbalance_of(s, s.accuracy.imbalance_tolerance);
  s.report.failure = rest_failure(rest, s.accuracy, may_go_on);
}

template <class Kind, class Real>
bool is_at_rest(Settling<Kind, Real>& s) {
  test_rest(s);
  return s.report.failure.empty();
}

/// Whether the forces of the last test of rest were found.
template <class Kind, class Real>
bool is_solved(const Settling<Kind, Real>& s) {
  return s.report.rest.step_residual <= s.accuracy.residual_tolerance;
}

/// Whether the forces were found, and more steps at rest will not balance them: the bed moves, has
/// too few contacts, or what they leave is several times what is allowed.
template <class Kind, class Real>
bool is_far_from_rest(const Settling<Kind, Real>& s) {
  constexpr double far = 3.0;
  const double imbalance = s.report.rest.imbalance.mean;  // 0 where another test failed
  return is_solved(s) && (imbalance == 0.0 || imbalance > far * s.accuracy.imbalance_tolerance);
}

/// Whether a bed that does not rest slides on, to be tested once more, and there are steps for it.
/// The higher it is, the more steps its forces take to settle before.
template <class Kind, class Real>
bool slides_on(const Settling<Kind, Real>& s) {
  constexpr double layers_of_a_step = 8.0;
  if (s.stage + 1 == s.stages.size() || s.rounds == most_rounds) return false;
  const bool has_settled =
      static_cast<double>(s.steps_in_stage) >= top_of(s.bed) / layers_of_a_step;
  return has_steps_to_go_on(s) && (has_settled || is_far_from_rest(s));
}

/// Whether the stage has done its work. Looks at the bed after at least one step.
template <class Kind, class Real>
bool is_over(Settling<Kind, Real>& s) {
  const bool has_steps = s.steps_in_stage >= steps_of(s.accuracy, s.rule());
  switch (s.rule().end) {
    case StageEnd::look:
      return has_steps || (s.steps_in_stage > 0 && !is_bed(s));
    case StageEnd::fallen:
      return has_steps && has_fallen(s);
    case StageEnd::halted:
      return has_steps && has_fallen(s) && s.last.kinetic_energy < s.accuracy.kinetic_tolerance;
    case StageEnd::rest:
      return has_steps && (is_at_rest(s) || slides_on(s));
    case StageEnd::steps:
      break;
  }
  return has_steps;
}

template <class Kind, class Real>
std::size_t next_stage(Settling<Kind, Real>& s) {
  const bool rests_as_given = s.rule().end == StageEnd::look && is_carried(s) && is_at_rest(s);
  const bool rests = s.rule().end == StageEnd::rest && s.report.failure.empty();
  if (rests_as_given || rests) return s.stages.size();
  return s.rule().back > 0 ? s.stage - s.rule().back : s.stage + 1;
}

template <class Kind, class Real>
void enter(std::size_t stage, Settling<Kind, Real>& s) {
  if (stage < s.stage) {
    ++s.rounds;
    s.unsolved = is_solved(s) ? 0 : s.unsolved + 1;
  }
  if (s.rounds == 0) s.iterations_before = s.report.iterations;
  s.stage = stage;
  s.steps_in_stage = 0;
  if (wake(s.bed)) s.state.candidates.is_listed = false;
  if (stage == s.stages.size()) return;
  s.is_tested = false;
  s.height = top_of(s.bed);
  const StepSettings settings = settings_of(s);
  change_step(settings.dt / s.settings.dt, s.bed, s.state);
  s.settings = settings;
}

// ---- saving and going on ----

/// Lists what a packing needs to go on.
template <class Archive, class Kind, class Real>
void transfer(Archive& archive, Settling<Kind, Real>& s) {
  archive.value(s.stage);
  archive.value(s.steps_in_stage);
  archive.value(s.height);
  archive.value(s.settings);
  archive.value(s.last);
  archive.value(s.sunk_at_start);
  archive.value(s.share_done);
  archive.value(s.rounds);
  archive.value(s.unsolved);
  archive.value(s.iterations_before);
  archive.value(s.searches_failed);
  archive.value(s.report.rest);
  archive.value(s.report.sank);
  archive.value(s.report.spurious_path);
  archive.value(s.report.steps);
  archive.value(s.report.iterations);
  transfer_bed(archive, s.bed, s.state);
}

/// States of other number types, of other kinds of grains and of other beds are of another kind.
template <class Kind, class Real>
std::uint64_t kind_of(const Settling<Kind, Real>& s) {
  constexpr bool turns = std::is_same_v<Kind, Polyhedron>;
  return s.bed.grains() * 32 + (turns ? 16 : 0) + sizeof(Real);
}

template <class Kind, class Real>
std::string saved(Settling<Kind, Real>& s) {
  StateWriter writer;
  transfer(writer, s);
  return sealed(kind_of(s), writer.bytes());
}

template <class Kind, class Real>
void restore(std::string_view bytes, Settling<Kind, Real>& s) {
  if (const auto payload = unsealed(kind_of(s), bytes)) {
    StateReader reader(*payload);
    transfer(reader, s);
  }
}

/// In the fall, while the bed fills up.
template <class Kind, class Real>
void let_sleep(Settling<Kind, Real>& s) {
  const bool looks = s.rule().sleeps && s.steps_in_stage > 0 &&
                     s.steps_in_stage % steps_between_looks == 0 && may_sleep(s.bed);
  if (looks && put_to_sleep(s.settings.dt, s.bed)) s.state.candidates.is_listed = false;
}

/// One step; false if the observer does not want another one.
template <class Kind, class Real>
bool take_step(Settling<Kind, Real>& s, const KeepGoing& keep_going) {
  let_sleep(s);
  s.last = step(s.settings, s.context, s.bed, s.state);
  s.is_tested = false;
  s.report.spurious_path += s.last.spurious_path;
  if (s.report.steps == 0) s.sunk_at_start = s.last.sunk;
  s.report.sank = s.report.sank || s.last.sunk > s.sunk_at_start + rounding_of_places;
  ++s.report.steps;
  ++s.steps_in_stage;
  s.report.iterations += s.last.solve.iterations;
  s.share_done = std::max(s.share_done, share_done(s.accuracy, s.rule(), s.steps_in_stage - 1));
  return keep_going({s.report.steps, s.share_done, [&s] { return saved(s); }});
}

/// Whether there is another step to take. Sliding on brings a bed to other contacts; it is of no
/// use where rounding keeps the forces of those that it has from being found. A state that is not
/// finite must not be searched: it lies in no cell.
template <class Kind, class Real>
bool goes_on(const Settling<Kind, Real>& s) {
  return s.stage < s.stages.size() && s.report.steps < s.accuracy.max_steps &&
         s.steps_in_stage < s.rule().most_steps && s.unsolved < most_unsolved &&
         !s.report.cancelled && std::isfinite(s.last.kinetic_energy);
}

// ---- what is found out once, at the end ----

/// Contacts of a bed whose independent ones are counted: the time grows with their square, and
/// twice as many take longer than a bed of so many takes to settle.
constexpr std::int64_t most_counted = 30'000;

template <class Kind, class Real>
void look_closer(Settling<Kind, Real>& s) {
  RestReport& rest = s.report.rest;
  const Contacts<Kind, Real>& contacts = s.state.contacts;
  const double dt = s.settings.dt;
  if (is_hyperstatic(rest, s.accuracy)) {
    rest.independent_contacts =
        rest.contacts > most_counted
            ? std::numeric_limits<double>::quiet_NaN()
            : static_cast<double>(independent_constraints(s.bed, s.context, dt, contacts));
  }
  if (!s.report.failure.empty()) {
    rest.imbalance = imbalance_of(s, std::numeric_limits<double>::infinity());
  }
}

template <class Kind, class Real>
void report_forces(const std::vector<ForceContact>& contacts, Settling<Kind, Real>& s) {
  s.report.force = force_sums(s.bed, contacts);
  s.report.pair_forces = pair_forces(s.bed, contacts);
  s.report.wall_forces = wall_forces(s.bed, contacts);
}

template <class Kind, class Real>
std::vector<ForceContact> contacts_of_last_step(const Settling<Kind, Real>& s) {
  return force_contacts(s.bed, s.settings.dt, s.state.contacts);
}

/// Whether a bed that passes the tests of rest rests: not if it was still on its way there when its
/// steps ran out.
template <class Kind, class Real>
bool has_arrived(const Settling<Kind, Real>& s) {
  return s.stage == s.stages.size() || s.rule().end == StageEnd::look ||
         (s.rule().end == StageEnd::rest && s.steps_in_stage >= steps_of(s.accuracy, s.rule()));
}

/// Of a bed that has come to rest, or has no steps left. What slept until then has contacts again,
/// though no forces: those are of the last step.
template <class Kind, class Real>
void tell_rest(Settling<Kind, Real>& s) {
  if (wake(s.bed)) s.state.candidates.is_listed = false, s.is_tested = false;
  if (!s.is_tested) test_rest(s);
  if (s.report.failure.empty() && !has_arrived(s)) {
    s.report.failure = "its steps ended in the stage " + std::string(s.rule().name) +
                       ", on its way to rest: make accuracy.max_steps larger";
  }
  look_closer(s);
  if (!s.report.failure.empty() && !is_high(s.bed)) {
    s.report.failure += remedy_of_rounding(s.report.rest, s.accuracy, top_of(s.bed));
  }
  report_forces(contacts_of_last_step(s), s);
}

// ---- exact rest ----

RestReport report_of(const ExactRest& exact, const SphereBed& bed) {
  RestReport rest;
  rest.overlap_mean = exact.overlap_mean;
  rest.overlap_max = exact.overlap_max;
  rest.contacts = static_cast<std::int64_t>(exact.contacts.size());
  rest.independent_contacts = static_cast<double>(rest.contacts);
  rest.held_by_turning =
      std::count_if(exact.contacts.begin(), exact.contacts.end(), [&](const ForceContact& contact) {
        return !bed.is_grain(contact.b) &&
               bed.walls[static_cast<std::size_t>(contact.b - bed.wall_name(0))].is_round();
      });
  rest.isostatic_contacts = degrees_of_freedom(bed) - zero_modes(bed, exact.contacts);
  rest.imbalance = exact.of_weight;
  return rest;
}

/// Brings the bed to exact rest; empty if that was found, else why not, and the bed stays as it is.
template <class Real>
std::string find_exact_rest(Settling<Sphere, Real>& s, const KeepGoing& keep_going,
                            double operations) {
  const auto goes_on_trying = [&] {
    s.report.cancelled = !keep_going({s.report.steps, s.share_done, [&s] { return saved(s); }});
    return !s.report.cancelled;
  };
  SphereBed bed = s.bed;
  const ExactRest exact =
      rest_exactly(s.context, contacts_of_last_step(s), bed, {goes_on_trying, operations});
  s.report.iterations += exact.rounds;
  if (!exact.failure.empty()) return exact.failure;
  const RestReport rest = report_of(exact, bed);
  if (rest.contacts + rest.held_by_turning < rest.isostatic_contacts) {
    return "it stands on fewer contacts than hold it";  // by symmetry alone
  }
  s.bed = std::move(bed);
  s.report.failure.clear();
  s.report.rest = rest;
  report_forces(exact.contacts, s);
  s.is_exact = true;
  return "";
}

/// Multiplications of a factorisation that a search may take: so many as last as long as sliding on
/// has; without limit after eight rounds where steps leave forces unsolved, as rounding does in
/// high beds, which sliding on does not mend.
template <class Kind, class Real>
double work_of_search(const Settling<Kind, Real>& s) {
  constexpr double of_a_grain_and_sweep = 50.0;
  constexpr std::int64_t rounds_in_vain = 8;
  if (!is_solved(s) && s.unsolved > 0 && s.rounds >= rounds_in_vain) return unlimited;
  return of_a_grain_and_sweep * static_cast<double>(s.report.iterations - s.iterations_before) *
         static_cast<double>(s.bed.grains());
}

/// Beds that have slid on in vain, as narrow towers do, are tried for exact rest after a round, 2,
/// 4, 8 and so on: so it costs about as much again, and beds that need a round or two, as most do,
/// are spared it where it is dear.
template <class Kind, class Real>
bool is_brought_to_rest(Settling<Kind, Real>& s, const KeepGoing& keep_going) {
  if constexpr (std::is_same_v<Kind, Sphere>) {
    return s.rule().end == StageEnd::rest && !s.report.failure.empty() &&
           std::has_single_bit(static_cast<std::uint64_t>(s.rounds)) &&
           find_exact_rest(s, keep_going, work_of_search(s)).empty();
  }
  return false;
}

/// Stage after stage, until the bed rests, the steps run out or the observer stops it.
template <class Kind, class Real>
void come_to_rest(Settling<Kind, Real>& s, const KeepGoing& keep_going) {
  while (goes_on(s)) {
    if (is_over(s)) {
      enter(is_brought_to_rest(s, keep_going) ? s.stages.size() : next_stage(s), s);
    } else {
      s.report.cancelled = !take_step(s, keep_going);
    }
  }
}

/// From a bed at rest in steps to exact rest, if that is asked for. One from which it is not found
/// slides on, to be tried again: then there is more to do.
template <class Kind, class Real>
bool slides_on_to_exact_rest(Settling<Kind, Real>& s, const KeepGoing& keep_going) {
  if constexpr (std::is_same_v<Kind, Sphere>) {
    constexpr std::int64_t most_failed = 3;
    if (s.accuracy.rest != Rest::exact || !s.report.failure.empty()) return false;
    const std::string failure = find_exact_rest(s, keep_going, unlimited);
    if (failure.empty() || s.report.cancelled) return false;
    ++s.searches_failed;
    if (s.searches_failed < most_failed && has_steps_to_go_on(s)) {
      enter(s.stages.size() - 1, s);
      return true;
    }
    s.report.failure = "at rest in steps, but exact rest was not found: " + failure +
                       "; take another seed, or accuracy.rest in_steps";
  }
  return false;
}

template <class Kind, class Real>
SettleReport settle_in(StepState<Kind, Real>& state, StepState<Kind, double>& closed,
                       const Accuracy& accuracy, const ExecutionContext& context, Bed<Kind>& bed,
                       const KeepGoing& keep_going, std::string_view saved) {
  forget(state);
  if (!is_fit(accuracy, bed)) {
    SettleReport precision_insufficient;
    precision_insufficient.precision_insufficient = true;
    precision_insufficient.failure =
        "the heaviest grain has more than 1e5 times the mass of the lightest, too much for "
        "accuracy.precision f32: take f64";
    return precision_insufficient;
  }
  const Stages stages = stages_of<Kind>(accuracy.protocol);
  Settling<Kind, Real> s{.accuracy = accuracy,
                         .context = context,
                         .bed = bed,
                         .state = state,
                         .closed = closed,
                         .stages = stages,
                         .height = top_of(bed),
                         .settings = settings_of(accuracy, stages.front(), top_of(bed))};
  restore(saved, s);
  do {
    come_to_rest(s, keep_going);
    if (s.report.cancelled || s.is_exact) return s.report;
    if (!std::isfinite(s.last.kinetic_energy)) {
      s.report.failure = "the kinetic energy is not a finite number";
      return s.report;
    }
    tell_rest(s);
  } while (slides_on_to_exact_rest(s, keep_going));
  return s.report;
}

}  // namespace

template <class Kind>
SettleReport settle(const Accuracy& accuracy, const ExecutionContext& context, Bed<Kind>& bed,
                    const KeepGoing& keep_going, std::string_view saved) {
  Workspace own;
  Workspace& memory = context.workspace != nullptr ? *context.workspace : own;
  const auto settle_as = [&](auto& state) {
    return settle_in(state, std::get<ClosedState<Kind>>(memory.closed), accuracy, context, bed,
                     keep_going, saved);
  };
  return accuracy.precision == Precision::f32
             ? settle_as(std::get<StepState<Kind, float>>(memory.states))
             : settle_as(std::get<StepState<Kind, double>>(memory.states));
}

template SettleReport settle(const Accuracy&, const ExecutionContext&, SphereBed&, const KeepGoing&,
                             std::string_view);
template SettleReport settle(const Accuracy&, const ExecutionContext&, PolyhedronBed&,
                             const KeepGoing&, std::string_view);

}  // namespace grainsweep
