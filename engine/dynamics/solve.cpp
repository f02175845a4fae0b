#include "engine/dynamics/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// By how much impulses miss, a mass times d: the worst row, and the root mean square over the rows
/// that push, with their number.
struct Residual {
  double largest, rms, loaded;
  bool is_within(const SolveLimits& limits) const {
    return largest <= limits.tolerance || rms <= limits.rms_tolerance;
  }
};

/// Nesterov's sequence, restarted where the objective would rise (O'Donoghue and Candes 2015).
class Momentum {
 public:
  double next() {
    const double squared = theta_ * theta_;
    const double theta = (std::sqrt(squared * squared + 4.0 * squared) - squared) / 2.0;
    const double momentum = theta_ * (1.0 - theta_) / (squared + theta);
    theta_ = theta;
    return momentum;
  }
  void restart() { theta_ = 1.0; }
  /// For impulses that are carried over from the last step. Begun at 1, a descent needs about a
  /// tenth more sweeps; below 0.15 it needs more, too.
  void begin() { theta_ = 0.25; }

 private:
  double theta_ = 1.0;
};

// In a small bed a sweep goes through all rows, and then the motion of all grains is extrapolated.
//
// In a large bed the rows lie in subdomains (engine/rows/subdomains.hpp) of two phases, A and B.
// The rows of a subdomain push its grains and the next one's: those of a phase are swept at the
// same time. Each turn is in one phase; numbers are sweeps:
//
//     subdomain   0   1   2   3   4   5
//     phase       A   B   A   B   A   B
//
//     turn 1      0       0       0         A begins sweep 0.
//     turn 2          0>1     0>1     0>1   B ends it: with subdomain 1, all rows of the grains
//                                           of 1 and 2 are swept. Their motion is extrapolated (>),
//                                           and B begins sweep 1 while its rows are in the cache.
//     turn 3      1>2     1>2     1>2       A ends sweep 1 for the grains of 0 and 1, 2 and 3, ..
//     turn 4          2>3     2>3     2>3   and begins sweep 2: rows are read from memory once for
//     finish      3>      3>      3>        two sweeps.
//
// A sweep ends with the momentum that it began with. Residual and restart test are those of a turn:
// the end of one sweep and the begin of the next; a restart takes effect in the next turn.

/// Projected Gauss-Seidel sweeps: each row is solved after those before it have moved, which is
/// worth nearly three gradient steps. With Nesterov's momentum, what a sweep changed in impulses
/// and motion is continued before the next one.
template <class Rows, class Real>
class GaussSeidel {
  using Sums = SweepSums<Real>;

 public:
  GaussSeidel(bool is_accelerated, const ExecutionContext& context, Rows& rows,
              MotionColumns<Real>& motion)
      : kernels_(context.kernels),
        record_kernels_(kernels_of<Real>(context.kernels).rows),
        loop_(context.loop),
        rows_(rows),
        motion_(motion),
        is_accelerated_(is_accelerated),
        has_momentum_(is_accelerated) {
    motion.u.resize(motion.free.size());
    motion.summed.resize(motion.free.size());
    motion.accumulated.assign(motion.free.size(), {Real(0), Real(0), Real(0), Real(0)});
    std::copy_n(motion.free.begin(), motion.first_moving, motion.u.begin());
    std::copy_n(motion.free.begin(), motion.first_moving, motion.summed.begin());
    set_motion(motion.u);
  }

  /// Starts from the impulses and their motion.
  void restart() {
    copy(rows_.impulse, rows_.extrapolated);
    copy(motion_.u, motion_.before);
    begun_.reset();
    momentum_.begin();
    least_seen_ = infinity;
    since_least_ = 0;
  }
  /// A sweep, or a turn of a large bed. Returns the residuals that it saw on the way.
  Residual iterate() {
    const SweepRule<Real> rule{is_accelerated_ ? relaxation_with_momentum : Real(1),
                               has_momentum_ ? static_cast<Real>(momentum_.next()) : Real(0)};
    const Sums sums = rows_.shares.phases() == 2 ? turn(rule) : whole_sweep(rule);
    if (is_accelerated_ && ++swept_ % sweeps_of_a_sum == 0) {
      end_sweep();
      recompute_motion();
    }
    if (sums.restart_test > 0) momentum_.restart();
    const Residual seen = residual_of(sums.missed);
    if constexpr (Rows::may_circle) leave_circle(seen.largest);
    first_seen_ = first_seen_ < 0.0 ? seen.largest : first_seen_;
    if (has_momentum_ && seen.largest > diverged * first_seen_) give_momentum_up();
    return seen;
  }
  /// Leaves the motion of the impulses behind, and returns their true residual.
  Residual finish() {
    end_sweep();
    set_motion(motion_.u);
    const Sums sums = sweep_all([&](BlockRange range) -> Sums {
      return {rows_.residual(kernels_, range, motion_.u.data()), Real(0)};
    });
    return residual_of(sums.missed);
  }

 private:
  /// A sweep is no gradient step, its matrix is not symmetric: from 1.1 on momentum makes beds of
  /// spheres diverge; between 0.8 and 1.05 they need equally many sweeps.
  static constexpr Real relaxation_with_momentum = static_cast<Real>(0.9);
  /// After so many sweeps the motion is summed anew: momentum multiplies what rounding adds.
  static constexpr int sweeps_of_a_sum = 32;
  /// A descent has diverged when its residual is so many times the first; others rise less than
  /// tenfold. Sweeps without momentum always go down.
  static constexpr double diverged = 100.0;
  /// After so many sweeps without a new least residual, while it is so many times the least, sweeps
  /// go round in circles. With 40 sweeps, or with 8 times, some circles go on; a descent that does
  /// get on passes such a wave only now and then.
  static constexpr int sweeps_in_vain = 20;
  static constexpr double risen = 2.0;

  /// Where rows hold a grain more often than it can move, as the corners of several faces do,
  /// momentum may drive them round in circles while all others converge. The restart test, a sum
  /// over all rows, does not see these few. With no momentum they converge, and have done so by the
  /// time it has grown again.
  void leave_circle(double largest) {
    if (!(largest < least_seen_)) {
      if (++since_least_ < sweeps_in_vain || largest <= risen * least_seen_) return;
      momentum_.restart();
    }
    least_seen_ = largest;
    since_least_ = 0;
  }

  Sums sweep(BlockRange range, const SweepRule<Real>& rule) {
    return rows_.sweep(kernels_, range, rule, motion_.u.data());
  }
  Sums whole_sweep(const SweepRule<Real>& rule) {
    const Sums sums = sweep_all([&](BlockRange range) { return sweep(range, rule); });
    visit_moving([&](std::size_t first, std::size_t count) {
      record_kernels_.extrapolate(rule.momentum, count, motion_.before.data() + first,
                                  motion_.u.data() + first);
    });
    return sums;
  }

  /// Ends the sweep that was begun and begins the next one in one phase; the next turn is in the
  /// other phase.
  Sums turn(const SweepRule<Real>& next) {
    const Sums sums = work_in_phase(phase_, [&](const RowPart& part) {
      const Sums ended = begun_ ? end(part) : Sums{};
      return joined(ended, begin(part, next));
    });
    phase_ = 1 - phase_;
    begun_ = next;
    return sums;
  }
  Sums begin(const RowPart& part, const SweepRule<Real>& rule) {
    return sweep_part(part, [&](BlockRange range) { return sweep(range, rule); });
  }
  Sums end(const RowPart& part) {
    const Sums sums = begin(part, *begun_);
    record_kernels_.extrapolate_grains(
        begun_->momentum, rows_.shares.grains.data() + part.first_grain, part.grains,
        Rows::records_of_grain, motion_.before.data(), motion_.u.data());
    return sums;
  }
  void end_sweep() {
    if (!begun_) return;
    work_in_phase(phase_, [&](const RowPart& part) { return end(part); });
    begun_.reset();
  }

  /// u = free + M^-1 H p, without the rounding that sweeps have gathered.
  void set_motion(std::vector<Record<Real>>& u) {
    visit_ranges(rows_.shares, loop_, [&](BlockRange range) {
      rows_.accumulate(kernels_, range, motion_.accumulated.data());
    });
    visit_moving([&](std::size_t first, std::size_t count) {
      record_kernels_.apply_impulses(motion_.free.data() + first, count,
                                     motion_.accumulated.data() + first, u.data() + first);
    });
  }
  /// Frees the motion of the impulses, and likewise the extrapolated motion, from what rounding has
  /// added: the difference between them is small, and is known better than either.
  void recompute_motion() {
    set_motion(motion_.summed);
    visit_moving([&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        const Record<Real>&right = motion_.summed[i], &wrong = motion_.before[i];
        motion_.u[i].x += right.x - wrong.x;
        motion_.u[i].y += right.y - wrong.y;
        motion_.u[i].z += right.z - wrong.z;
      }
    });
    motion_.before.swap(motion_.summed);
  }
  /// Begins again from no impulses at all.
  void give_momentum_up() {
    has_momentum_ = false;
    rows_.drop_impulses();
    set_motion(motion_.u);
    restart();
  }

  static Sums joined(const Sums& one, const Sums& other) {
    return {{std::max(one.missed.largest, other.missed.largest),
             one.missed.squares + other.missed.squares, one.missed.loaded + other.missed.loaded},
            one.restart_test + other.restart_test};
  }
  /// Infinite if impulses or motions have grown beyond all numbers: a maximum passes over what is
  /// NaN, a sum does not.
  static Residual residual_of(const Missed<Real>& missed) {
    const auto squares = static_cast<double>(missed.squares);
    const auto loaded = static_cast<double>(missed.loaded);
    if (!std::isfinite(squares)) {
      return {infinity, infinity, loaded};
    }
    return {static_cast<double>(missed.largest), std::sqrt(squares / std::max(loaded, 1.0)),
            loaded};
  }
  /// Sums of what sweep(range) sees in all ranges of a part, one after the other.
  template <class Sweep>
  Sums sweep_part(const RowPart& part, const Sweep& sweep) {
    Sums sums{};
    visit_ranges(rows_.shares, part, [&](BlockRange range) { sums = joined(sums, sweep(range)); });
    return sums;
  }
  /// Sums of what work(part) sees in all parts of a phase, at the same time.
  template <class Work>
  Sums work_in_phase(std::size_t phase, const Work& work) {
    const PhaseParts parts = parts_of_phase(rows_.shares, phase);
    motion_.seen.resize(parts.last - parts.first);
    parallel_for(loop_, motion_.seen.size(), [&](std::size_t k) {
      motion_.seen[k] = work(rows_.shares.parts[parts.first + k]);
    });
    Sums sums{};
    for (const Sums& one : motion_.seen) sums = joined(sums, one);
    return sums;
  }
  /// Sums over all rows of what sweep(range) sees, phase after phase.
  template <class Sweep>
  Sums sweep_all(const Sweep& sweep) {
    Sums sums{};
    for (std::size_t phase = 0; phase < rows_.shares.phases(); ++phase) {
      const auto work = [&](const RowPart& part) { return sweep_part(part, sweep); };
      sums = joined(sums, work_in_phase(phase, work));
    }
    return sums;
  }

  /// The same for the records that something may move.
  template <class Work>
  void visit_moving(const Work& work) {
    const std::size_t before = motion_.first_moving;
    parallel_items(loop_, motion_.u.size() - before,
                   [&](std::size_t first, std::size_t count) { work(before + first, count); });
  }
  template <class Item>
  void copy(const std::vector<Item>& from, std::vector<Item>& to) {
    to.resize(from.size());
    parallel_items(loop_, from.size(), [&](std::size_t first, std::size_t count) {
      std::copy_n(from.data() + first, count, to.data() + first);
    });
  }

  const Kernels& kernels_;
  const RowKernels<Real>& record_kernels_;  ///< for what is done to records, whatever the rows
  const ParallelFor& loop_;
  Rows& rows_;
  MotionColumns<Real>& motion_;
  const bool is_accelerated_;
  bool has_momentum_;  ///< until it is given up
  Momentum momentum_;
  double least_seen_ = infinity;  ///< residual since a restart
  int since_least_ = 0;           ///< sweeps
  double first_seen_ = -1.0;      ///< residual at the begin of the descent; none yet if negative
  int swept_ = 0;
  std::size_t phase_ = 0;                 ///< of the next turn
  std::optional<SweepRule<Real>> begun_;  ///< rule of the sweep that the last turn began
};

}  // namespace

// The residual that sweeps see only says when to look at the true one: next when it has fallen by
// the factor by which the true one was found too large.
template <class Rows, class Real>
SolveReport solve(const SolveLimits& limits, const ExecutionContext& context, Rows& contacts,
                  MotionColumns<Real>& motion) {
  GaussSeidel<Rows, Real> descent(limits.solver == Solver::accelerated_gauss_seidel, context,
                                  contacts, motion);
  SolveReport report;
  SolveLimits worth_a_look = limits;
  std::int64_t most = limits.iterations;
  constexpr int most_in_vain = 2;  // one alone may come before others that help
  int in_vain = 0;                 // doublings that did not bring the residual down
  double left_before = infinity;   // when iterations were doubled
  for (bool is_done = false; !is_done;) {
    descent.restart();
    Residual seen{};
    do {
      seen = descent.iterate();
      ++report.iterations;
    } while (report.iterations < most && !seen.is_within(worth_a_look));
    const Residual left = descent.finish();
    report.residual = left.largest;
    report.rms = left.rms;
    report.loaded = left.loaded;
    const bool is_spent = report.iterations >= most;
    if (is_spent && left.largest >= left_before) ++in_vain;
    const bool may_continue =
        left.largest > limits.residual_cap && most < limits.iteration_cap && in_vain < most_in_vain;
    is_done = left.is_within(limits) || (is_spent && !may_continue);
    if (is_spent) {
      most *= 2;
      left_before = left.largest;
    }
    worth_a_look.tolerance =
        std::min(seen.largest, worth_a_look.tolerance) * limits.tolerance / left.largest;
    worth_a_look.rms_tolerance =
        std::min(seen.rms, worth_a_look.rms_tolerance) * limits.rms_tolerance / left.rms;
  }
  return report;
}

template SolveReport solve(const SolveLimits&, const ExecutionContext&, SphereContacts<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, SphereContacts<double>&,
                           MotionColumns<double>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, PolyhedronContacts<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, PolyhedronContacts<double>&,
                           MotionColumns<double>&);

}  // namespace grainsweep
