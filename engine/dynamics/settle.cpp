#include "engine/dynamics/settle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "engine/dynamics/balance.hpp"
#include "engine/dynamics/changes.hpp"
#include "engine/dynamics/columns.hpp"
#include "engine/dynamics/inertia.hpp"
#include "engine/dynamics/rank.hpp"
#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/saved_beds.hpp"
#include "engine/dynamics/sleep.hpp"
#include "engine/dynamics/stages.hpp"
#include "engine/dynamics/workspace.hpp"
#include "engine/exact/exact_rest.hpp"
#include "engine/saved_state.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr double carried_share = 0.9;        // of its weight, where the floor carries a bed
constexpr std::int64_t steps_down = 4;       // in which forces get down to the floor
constexpr std::int64_t most_rounds = 128;    // a bed that needs more does not come to rest
constexpr double longest_in_a_round = 0.02;  // d; see longest_of_round
constexpr std::int64_t rounds_of_a_turn = 4;
constexpr std::int64_t most_unsolved = 9;  // rounds in a row that leave forces unsolved
constexpr double unlimited = infinity;
constexpr double rounding_of_places = 1e-9;  // d; far from the origin coordinates have fewer digits

bool is_fit(const Accuracy& accuracy, const Grains& bed) {
  return accuracy.precision == Precision::f64 || mass_ratio(bed) <= f32_mass_ratio;
}

/// Most contacts of a bed whose independent contacts are counted: the time grows with their square,
/// and for twice as many it is longer than such a bed takes to settle.
constexpr std::int64_t most_counted = 30'000;

/// Of all grains, d; of polyhedra what scales them.
double mean_diameter(const Grains& bed) {
  double sum = 0.0;
  for (const Record<double>& p : bed.centres()) sum += 2.0 * p.w;
  return sum / static_cast<double>(bed.grains());
}

/// Whether sizes are so alike that grains may stand regularly, on contacts that depend on each
/// other or nearly do: in tubes and ducts that just hold layers a spread of 1e-4 does not prevent
/// that everywhere.
bool are_nearly_of_one_size(const SphereBed& bed) {
  constexpr double alike = 1e-3;
  const auto by_radius = [](const Record<double>& p, const Record<double>& q) { return p.w < q.w; };
  const std::span<const Record<double>> grains = bed.centres();
  const auto [least, most] = std::minmax_element(grains.begin(), grains.end(), by_radius);
  return most->w < (1.0 + alike) * least->w;
}

/// No sphere moves so far in a step that it gets past a smaller one unseen: pairs that are further
/// apart than `near` before the step are not rows. Polyhedra fall more slowly.
void limit_free_motion(const SphereBed& bed, StepSettings& settings) {
  double smallest = infinity;
  for (const Record<double>& p : bed.centres()) smallest = std::min(smallest, p.w);
  settings.longest_free = std::min(settings.longest_free, settings.near + smallest);
}
void limit_free_motion(const PolyhedronBed& /*bed*/, StepSettings& /*settings*/) {}

RestReport report_of(const ExactRest& exact, const SphereBed& bed) {
  RestReport rest;
  rest.overlap_mean = exact.overlap_mean;
  rest.overlap_max = exact.overlap_max;
  rest.contacts =
      std::count_if(exact.contacts.begin(), exact.contacts.end(),
                    [&](const ForceContact& contact) { return !is_held_by(bed, contact); });
  rest.held_by_turning =
      std::count_if(exact.contacts.begin(), exact.contacts.end(), [&](const ForceContact& contact) {
        return !bed.is_grain(contact.b) &&
               bed.walls[static_cast<std::size_t>(contact.b - bed.wall_name(0))].is_round();
      });
  rest.isostatic_contacts = isostatic_count(bed, exact.contacts);
  // As many as hold the bed: any more depend on these.
  rest.independent_contacts = static_cast<double>(std::min(rest.contacts, rest.isostatic_contacts));
  rest.imbalance = exact.of_weight;
  return rest;
}

/// A bed on its way to rest, and all that it carries from step to step.
template <class Kind, class Real>
class Settling {
 public:
  Settling(const Accuracy& accuracy, const ExecutionContext& context, const KeepGoing& keep_going,
           StepState<Kind, Real>& state, StepState<Kind, double>& closed, Bed<Kind>& bed)
      : accuracy_(accuracy),
        context_(context),
        keep_going_(keep_going),
        bed_(bed),
        state_(state),
        closed_(closed),
        stages_(stages_of<Kind>(accuracy.protocol)),
        mean_diameter_(mean_diameter(bed)),
        height_(top_of(bed)),
        settings_(settings_of_stage()) {
    forget(state);
  }

  /// Starts from where the bytes were saved, if they are of this bed.
  SettleReport run(std::string_view bytes) {
    if (!is_fit(accuracy_, bed_)) {
      report_.precision_insufficient = true;
      report_.failure =
          "the heaviest grain has more than 1e5 times the mass of the lightest, too much for "
          "accuracy.precision f32: take f64";
      return report_;
    }
    restore(bytes);
    do {
      come_to_rest();
      if (report_.cancelled || is_exact_) return report_;
      if (!std::isfinite(last_.kinetic_energy)) {
        report_.failure = "the kinetic energy is not a finite number";
        return report_;
      }
      tell_rest();
    } while (slides_on_to_exact_rest());
    return report_;
  }

 private:
  const StageRule& rule() const { return stages_[stage_]; }

  /// The stage from which a bed that fails the last one, its rest, goes on.
  std::size_t round_begin() const { return stages_.size() - 2; }

  StepSettings settings_of_stage() const {
    StepSettings settings = settings_of(accuracy_, rule(), height_, height_ / mean_diameter_);
    limit_free_motion(bed_, settings);
    return settings;
  }

  /// See static_imbalance.
  Imbalance imbalance_of(double of_interest) {
    return static_imbalance(accuracy_.imbalance_gap, of_interest, context_, bed_, settings_.dt,
                            state_.contacts, closed_);
  }

  // ---- stage after stage ----

  bool is_carried() const { return last_.carried > carried_share; }

  /// Whether nothing moves the bed by more than it may be out of balance.
  bool is_calm() const { return last_.mean_motion < calm_motion(accuracy_, rule()); }

  bool has_fallen() const { return last_.kinetic_energy < rule().energy && is_carried(); }

  /// Whether what is looked at may be a bed at rest, which the floor carries. For most beds the
  /// first step shows it; the forces of a high bed take some steps to get down to the floor.
  bool is_bed() const {
    constexpr double enough_at_first = 0.3;
    return last_.carried > (steps_in_stage_ < steps_down ? enough_at_first : carried_share);
  }

  /// Steps left until the stage has taken its least number. A bed whose forces were not found for
  /// some rounds eases on for longer: it is calm, but its contacts lie such that sweeps take long.
  std::int64_t steps_left() const {
    constexpr std::int64_t rounds_alike = 3;
    const std::int64_t times = rule().end == StageEnd::calm ? 1 + unsolved_ / rounds_alike : 1;
    return std::min(times * steps_of(accuracy_, rule()), rule().most_steps) - steps_in_stage_;
  }

  /// Longest motion of polyhedra that slide on, d: one that is pressed out of an overlap by a turn
  /// which undoes that to second order would turn back in the next step, and so on for ever. Three
  /// rounds in four move in ever smaller steps; in the fourth jammed grains may get free.
  double longest_of_round() const {
    const std::int64_t part = rounds_ % rounds_of_a_turn;
    const bool is_short = std::is_same_v<Kind, Polyhedron> && part > 0;
    return is_short ? longest_in_a_round / static_cast<double>(part) : longest_motion;
  }

  /// How many steps are taken on contacts found once. Tests of rest look at the contacts of the
  /// very last step.
  int steps_at_once() const {
    const std::int64_t untested = steps_left() - (rule().end == StageEnd::rest ? 1 : 0);
    return static_cast<int>(std::clamp<std::int64_t>(untested, 1, settings_.steps));
  }

  /// Settings of the stage, with more iterations if its first steps look like those of a bed.
  StepSettings settings_of_step() const {
    StepSettings settings = settings_;
    settings.steps = steps_at_once();
    const bool looks_closer = rule().end == StageEnd::look && steps_in_stage_ >= steps_down;
    if (looks_closer) settings.limits.iterations *= rule().closer;
    settings.longest = longest_of_round();
    return settings;
  }

  /// Whether there are steps left for sliding on before the bed is tested once more, at least.
  bool has_steps_to_go_on() const {
    const std::int64_t round =
        steps_of(accuracy_, stages_[round_begin()]) + steps_of(accuracy_, stages_.back());
    return report_.steps + round <= accuracy_.max_steps;
  }

  /// All tests of rest; that of the static balance, which costs as much as some steps, only for
  /// beds that pass the others.
  void test_rest() {
    is_tested_ = true;
    RestReport& rest = report_.rest;
    rest = measure_rest(bed_, context_, settings_.dt, state_);
    rest.step_residual = last_.solve.residual;
    rest.kinetic_energy = last_.kinetic_energy;
    rest.largest_motion = last_.largest_motion;
    const bool has_steps = has_steps_to_go_on();
    report_.failure = rest_failure(rest, accuracy_, has_steps);
    if (!report_.failure.empty()) return;
    rest.imbalance = imbalance_of(accuracy_.imbalance_tolerance);
    report_.failure = rest_failure(rest, accuracy_, has_steps);
  }

  /// Whether a bed that has had its steps is tested after this one: of beds so high that they go on
  /// at rest the test of the static balance would cost more than the steps.
  bool is_to_be_tested() const {
    constexpr std::int64_t steps_between_tests = 4;
    return -steps_left() % steps_between_tests == 0;
  }

  bool is_at_rest() {
    test_rest();
    return report_.failure.empty();
  }

  /// Whether the forces of the last test of rest were found.
  bool is_solved() const { return report_.rest.step_residual <= accuracy_.residual_tolerance; }

  /// Whether more than rounding kept forces from being found: those of polyhedra that rock from an
  /// edge to a face of a neighbour and back are found once these lie differently.
  bool rocks() const {
    return std::is_same_v<Kind, Polyhedron> &&
           report_.rest.step_residual > error_of_a_layer * height_;
  }

  /// Whether a bed failed its last test of rest by its balance alone, and by little.
  bool is_nearly_balanced() const {
    constexpr double far = 3.0;
    const double imbalance = report_.rest.imbalance.mean;  // 0 where another test failed
    return imbalance > 0.0 && imbalance <= far * accuracy_.imbalance_tolerance;
  }

  /// Whether the forces were found, and more steps at rest will not balance them: the bed moves,
  /// has too few contacts, or what they leave is several times what is allowed.
  bool is_far_from_rest() const { return is_solved() && !is_nearly_balanced(); }

  /// Whether a bed that does not rest slides on, to be tested once more. The higher the bed, the
  /// more steps its forces take to settle before that.
  bool slides_on() const {
    constexpr double layers_of_a_step = 8.0;
    if (rounds_ == most_rounds) return false;
    const double most = static_cast<double>(rule().most_steps - 1);
    const bool has_settled =
        static_cast<double>(steps_in_stage_) >= std::min(most, top_of(bed_) / layers_of_a_step);
    return has_settled || is_far_from_rest();
  }

  /// Whether more steps of a look will not find a bed at rest that was tested and is not. Forces
  /// that are not found yet do not show that.
  bool is_seen() const {
    constexpr std::int64_t looks = 4;
    return is_far_from_rest() || steps_in_stage_ >= looks * steps_of(accuracy_, rule());
  }

  /// Whether the stage has done its work. Looks at the bed after at least one step.
  bool is_over() {
    const bool has_its_steps = steps_left() <= 0;
    switch (rule().end) {
      case StageEnd::look:
        if (steps_in_stage_ > 0 && !is_bed()) return true;
        return has_its_steps && (is_at_rest() || is_seen());
      case StageEnd::fallen:
        return has_its_steps && has_fallen();
      case StageEnd::halted:
        return has_its_steps && has_fallen() && last_.kinetic_energy < accuracy_.kinetic_tolerance;
      case StageEnd::calm:
        return has_its_steps && (is_calm() || steps_in_stage_ >= rule().most_steps);
      case StageEnd::rest:
        return has_its_steps && is_to_be_tested() && (is_at_rest() || slides_on());
      case StageEnd::steps:
        break;
    }
    return has_its_steps;
  }

  std::size_t next_stage() {
    const bool rests = is_tested_ && report_.failure.empty();  // stages that end in tests have them
    if (rests) return stages_.size();
    return stage_ + 1 == stages_.size() ? round_begin() : stage_ + 1;
  }

  void enter(std::size_t stage) {
    if (stage < stage_) {
      ++rounds_;
      unsolved_ = is_solved() || rocks() ? 0 : unsolved_ + 1;
    }
    if (rounds_ == 0) iterations_before_ = report_.iterations;
    stage_ = stage;
    steps_in_stage_ = 0;
    if (wake(bed_)) state_.candidates.is_listed = false;
    if (stage == stages_.size()) return;
    is_tested_ = false;
    height_ = top_of(bed_);
    set_inertia_by_depth(rule().by_depth ? height_ : 0.0, bed_);
    const StepSettings settings = settings_of_stage();
    change_step(settings.dt / settings_.dt, bed_, state_);
    settings_ = settings;
  }

  // ---- saving and going on ----

  /// Lists what a packing needs to go on.
  template <class Archive>
  void transfer(Archive& archive) {
    archive.value(stage_);
    archive.value(steps_in_stage_);
    archive.value(height_);
    archive.value(settings_);
    archive.value(last_);
    archive.value(sunk_at_start_);
    archive.value(share_done_);
    archive.value(rounds_);
    archive.value(unsolved_);
    archive.value(iterations_before_);
    archive.value(searches_failed_);
    archive.value(report_.rest);
    archive.value(report_.sank);
    archive.value(report_.spurious_path);
    archive.value(report_.steps);
    archive.value(report_.iterations);
    transfer_bed(archive, bed_, state_);
  }

  /// States of other number types, of other kinds or numbers of grains and of programs in which
  /// a report has other members are of another kind.
  std::uint64_t kind_of() const {
    constexpr bool turns = std::is_same_v<Kind, Polyhedron>;
    constexpr std::uint64_t layout =
        sizeof(StepSettings) + (sizeof(StepReport) << 10U) + (sizeof(RestReport) << 20U);
    return (layout << 32U) + bed_.grains() * 32 + (turns ? 16 : 0) + sizeof(Real);
  }

  /// Includes a search for exact rest that is under way, which began from this state.
  std::string saved() {
    StateWriter writer;
    transfer(writer);
    writer.column(save_search_ ? save_search_() : search_);
    return sealed(kind_of(), writer.bytes());
  }

  void restore(std::string_view bytes) {
    if (const auto payload = unsealed(kind_of(), bytes)) {
      StateReader reader(*payload);
      transfer(reader);
      reader.column(search_);
    }
  }

  /// In the fall, while the bed fills up.
  void let_sleep() {
    const bool looks = rule().sleeps && steps_in_stage_ > 0 &&
                       steps_in_stage_ % steps_between_looks == 0 && may_sleep(bed_);
    if (looks && put_to_sleep(settings_.dt, bed_)) state_.candidates.is_listed = false;
  }

  /// Takes one step; false if the observer does not want another one.
  bool take_step() {
    let_sleep();
    last_ = step(settings_of_step(), context_, bed_, state_);
    is_tested_ = false;
    report_.spurious_path += last_.spurious_path;
    if (report_.steps == 0) sunk_at_start_ = last_.sunk;
    report_.sank = report_.sank || last_.sunk > sunk_at_start_ + rounding_of_places;
    report_.steps += last_.steps;
    steps_in_stage_ += last_.steps;
    report_.iterations += last_.solve.iterations;
    share_done_ = std::max(share_done_, share_done(accuracy_, rule(), steps_in_stage_ - 1));
    return may_go_on();
  }

  /// What the observer says.
  bool may_go_on() {
    return keep_going_({report_.steps, share_done_, [this] { return saved(); }});
  }

  /// Whether there is another step to take. Sliding on brings a bed to other contacts; that is no
  /// help where rounding keeps the forces of its present contacts from being found. A state that is
  /// not finite must not be searched: it lies in no cell.
  bool goes_on() const {
    return stage_ < stages_.size() && report_.steps + steps_at_once() <= accuracy_.max_steps &&
           (rule().end != StageEnd::rest || steps_in_stage_ < rule().most_steps) &&
           unsolved_ < most_unsolved && !report_.cancelled && std::isfinite(last_.kinetic_energy);
  }

  // ---- what is found out once, at the end ----

  void look_closer() {
    RestReport& rest = report_.rest;
    const Contacts<Kind, Real>& contacts = state_.contacts;
    const double dt = settings_.dt;
    if (!is_exact_ && is_hyperstatic(rest, accuracy_)) {
      rest.independent_contacts =
          rest.contacts > most_counted
              ? std::numeric_limits<double>::quiet_NaN()
              : static_cast<double>(independent_constraints(bed_, context_, dt, contacts));
    }
    if (!report_.failure.empty()) {
      rest.imbalance = imbalance_of(unlimited);
    }
  }

  /// `lines`: of each contact; none of spheres.
  void report_forces(const std::vector<ForceContact>& contacts,
                     const std::vector<ForceLine>& lines = {}) {
    report_.force = force_sums(bed_, contacts);
    std::tie(report_.forces, report_.lines) = pair_forces(bed_, contacts, lines);
    std::tie(report_.wall_forces, report_.wall_lines) = wall_forces(bed_, contacts, lines);
  }

  std::vector<ForceContact> contacts_of_last_step() const {
    return force_contacts(bed_, settings_.dt, state_.contacts);
  }

  /// Whether a bed that passes the tests of rest is at rest: not if it was still on its way there
  /// when its steps ran out.
  bool has_arrived() const {
    if (stage_ == stages_.size()) return true;
    const bool ends_in_a_test =
        rule().end == StageEnd::look || (rule().end == StageEnd::rest && is_to_be_tested());
    return ends_in_a_test && steps_left() <= 0;
  }

  /// Reports on a bed that has come to rest, or has no steps left. Grains that slept until then
  /// have contacts again, though no forces: those are of the last step. Inertia is mass again.
  void tell_rest() {
    if (wake(bed_)) state_.candidates.is_listed = false, is_tested_ = false;
    set_inertia_by_depth(0.0, bed_);
    if (!is_tested_) test_rest();
    if (report_.failure.empty() && !has_arrived()) {
      report_.failure = "its steps ended in the stage " + std::string(rule().name) +
                        ", on its way to rest: " + remedy_of_steps(accuracy_);
    }
    look_closer();
    if (!report_.failure.empty() && !is_high(bed_)) {
      report_.failure += remedy_of_rounding(report_.rest, accuracy_, top_of(bed_));
    }
    const std::vector<ForceContact> contacts = contacts_of_last_step();
    if constexpr (std::is_same_v<Kind, Polyhedron>) {
      report_forces(contacts, force_lines(bed_, state_.contacts, settings_.dt));
    } else {
      report_forces(contacts);
    }
  }

  // ---- exact rest ----

  /// Brings the bed to exact rest. Returns "" if that was found, else why not; the bed then stays
  /// as it is.
  std::string find_exact_rest(double operations) {
    const auto goes_on_trying = [&](const SaveSearch& save) {
      save_search_ = save;
      report_.cancelled = !may_go_on();
      save_search_ = {};
      return !report_.cancelled;
    };
    SphereBed bed = bed_;
    const std::string saved = std::exchange(search_, {});
    const ExactRest exact =
        rest_exactly(context_, contacts_of_last_step(), bed,
                     {.keep_going = goes_on_trying, .operations = operations, .saved = saved});
    report_.iterations += exact.rounds;
    if (!exact.failure.empty()) return exact.failure;
    const RestReport rest = report_of(exact, bed);
    if (rest.contacts + rest.held_by_turning < rest.isostatic_contacts) {
      return "it stands on fewer contacts than hold it";  // by symmetry alone
    }
    if (accuracy_.rest == Rest::exact && rest.contacts > rest.isostatic_contacts) {
      return "more contacts bear it than hold it, so that its forces are not unique";
    }
    bed_ = std::move(bed);
    report_.failure.clear();
    report_.rest = rest;
    report_forces(exact.contacts);
    is_exact_ = true;
    return "";
  }

  /// Multiplications of factorisations that a search may take: as many as last as long as sliding
  /// on has lasted; without limit after eight rounds in a row in which steps leave forces unsolved,
  /// as rounding does in high beds, which sliding on does not help.
  double work_of_search() const {
    constexpr double of_a_grain_and_sweep = 50.0;
    constexpr std::int64_t rounds_in_vain = 8;
    if (!is_solved() && unsolved_ >= rounds_in_vain) return unlimited;
    return of_a_grain_and_sweep * static_cast<double>(report_.iterations - iterations_before_) *
           static_cast<double>(bed_.grains());
  }

  /// Beds that have slid on in vain, as narrow towers do, are tried for exact rest after a round,
  /// 2, 4, 8 and so on: so it costs about as much again, and beds that need a round or two, as most
  /// do, are spared it where it is expensive.
  bool is_brought_to_rest() {
    if constexpr (std::is_same_v<Kind, Sphere>) {
      return rule().end == StageEnd::rest && !report_.failure.empty() &&
             std::has_single_bit(static_cast<std::uint64_t>(rounds_)) &&
             find_exact_rest(work_of_search()).empty();
    }
    return false;
  }

  /// Stage after stage, until the bed rests, the steps run out or the observer stops it. No bed
  /// that settles depends on how many steps there are: one that has none for another round is given
  /// up.
  void come_to_rest() {
    while (goes_on()) {
      if (!is_over()) {
        report_.cancelled = !take_step();
        continue;
      }
      const std::size_t next = is_brought_to_rest() ? stages_.size() : next_stage();
      if (next < stage_ && !has_steps_to_go_on()) return;
      enter(next);
    }
  }

  /// Goes from a bed at rest in steps to exact rest, if that is asked for. A bed from which it is
  /// not found slides on, to be tried again; returns whether it does.
  bool slides_on_to_exact_rest() {
    if constexpr (std::is_same_v<Kind, Sphere>) {
      constexpr std::int64_t most_failed = 3;
      if (accuracy_.rest != Rest::exact || !report_.failure.empty()) return false;
      const std::string failure = find_exact_rest(unlimited);
      if (failure.empty() || report_.cancelled) return false;
      ++searches_failed_;
      if (searches_failed_ < most_failed && has_steps_to_go_on()) {
        enter(round_begin());
        return true;
      }
      report_.failure =
          "at rest in steps, but exact rest was not found: " + failure + "; " +
          (are_nearly_of_one_size(bed_) ? "give sizes a spread, as of 1e-3" : "take another seed") +
          ", or accuracy.rest in_steps";
    }
    return false;
  }

  const Accuracy& accuracy_;
  const ExecutionContext& context_;
  const KeepGoing& keep_going_;
  Bed<Kind>& bed_;
  StepState<Kind, Real>& state_;
  StepState<Kind, double>& closed_;  ///< memory of the static balance
  Stages stages_;
  std::size_t stage_ = 0;  ///< the number of stages when the bed is at rest
  std::int64_t steps_in_stage_ = 0;
  double mean_diameter_;
  double height_;  ///< of the bed when the stage began, d
  StepSettings settings_;
  StepReport last_;
  double sunk_at_start_ = 0.0;  ///< StepReport::sunk of the first step
  double share_done_ = 0.0;     ///< the largest that was reported
  std::int64_t rounds_ = 0;     ///< how often the last stages came again
  std::int64_t unsolved_ = 0;   ///< so many of the last rounds ended with too large a residual
  std::int64_t iterations_before_ = 0;  ///< iterations until the bed was first tested for rest
  std::int64_t searches_failed_ = 0;    ///< searches for exact rest from a bed at rest in steps
  std::string search_;      ///< for exact rest, as saved; the next search goes on from it
  SaveSearch save_search_;  ///< saves the search that is under way
  bool is_tested_ = false;  ///< whether the report describes the rest of the bed as it is now
  bool is_exact_ = false;   ///< whether the report is that of exact rest
  SettleReport report_;
};

}  // namespace

template <class Kind>
SettleReport settle(const Accuracy& accuracy, const ExecutionContext& context, Bed<Kind>& bed,
                    const KeepGoing& keep_going, std::string_view saved) {
  Workspace own;
  Workspace& memory = context.workspace != nullptr ? *context.workspace : own;
  const Accuracy closer = closer_where_narrow(accuracy, bed.box);
  const auto settle_as = [&](auto& state) {
    return Settling(closer, context, keep_going, state,
                    std::get<StepState<Kind, double>>(memory.closed), bed)
        .run(saved);
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
