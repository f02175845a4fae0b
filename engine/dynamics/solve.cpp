#include "engine/dynamics/solve.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace grainsweep {

namespace {

/// What a solver works on: rows, their kernels, and the motion of their grains.
template <class Rows, class RowsKernels, class Real>
struct Work {
  using Number = Real;

  const RowsKernels& kernels;
  const RowKernels<Real>& record_kernels;  ///< for what is done to records, whatever the rows
  const ParallelFor& loop;
  Rows& contacts;
  MotionColumns<Real>& motion;
};

/// Rows of spheres; each row has its impulse at its own place.
template <class Real>
struct SphereProblem : Work<Contacts<Real>, RowKernels<Real>, Real> {
  /// Upper bound of the largest eigenvalue of A scaled by its diagonal; 3.3 is the largest seen in
  /// any bed of spheres.
  static constexpr double eigenvalue_bound = 3.95;

  const RowBlock<Real>* rows(BlockRange range) const {
    return this->contacts.rows.data() + range.first;
  }
  Real* impulse(BlockRange range) const {
    return this->contacts.impulse.data() + range.first * block_width;
  }
  Real* extrapolated(BlockRange range) const {
    return this->contacts.extrapolated.data() + range.first * block_width;
  }
};

/// Rows with levers; a block says where its impulses are.
template <class Real>
struct LeverProblem : Work<LeverColumns<Real>, LeverKernels<Real>, Real> {
  /// The same bound of A scaled by the row sums of its contacts; 4.25 is the largest seen in
  /// beds of pinacoids of one and two sizes, 3.5 in one of rocks of 20 corners.
  static constexpr double eigenvalue_bound = 4.3;

  LeverRows<Real> rows(BlockRange range) const {
    return {this->contacts.blocks.data() + range.first, this->contacts.points.data()};
  }
  Real* impulse(BlockRange) const { return this->contacts.impulse.data(); }
  Real* extrapolated(BlockRange) const { return this->contacts.extrapolated.data(); }
};

enum class SweepOrder { forward, backward };

template <class Real>
SweepSums<Real> joined(const SweepSums<Real>& one, const SweepSums<Real>& other) {
  return {std::max(one.residual, other.residual), one.uphill + other.uphill};
}

/// Sums of what sweep(range) sees in all ranges of a part, one after the other.
template <class Problem, class Sweep>
SweepSums<typename Problem::Number> sweep_part(const Problem& problem, const RowPart& part,
                                               const Sweep& sweep) {
  SweepSums<typename Problem::Number> sums{};
  visit_ranges(problem.contacts.shares, part,
               [&](BlockRange range) { sums = joined(sums, sweep(range)); });
  return sums;
}

/// Sums of what work(part) sees in all parts of a phase, at the same time.
template <class Problem, class Work>
SweepSums<typename Problem::Number> work_in_phase(Problem& problem, std::size_t phase,
                                                  const Work& work) {
  using Real = typename Problem::Number;
  const RowShares& shares = problem.contacts.shares;
  const PhaseParts parts = parts_of_phase(shares, phase);
  std::vector<SweepSums<Real>>& seen = problem.motion.seen;
  seen.resize(parts.last - parts.first);
  parallel_for(problem.loop, seen.size(),
               [&](std::size_t k) { seen[k] = work(shares.parts[parts.first + k]); });
  SweepSums<Real> sums{};
  for (const SweepSums<Real>& one : seen) sums = joined(sums, one);
  return sums;
}

/// Sums over all rows of what sweep(range) sees: phase after phase, or from the last one to the
/// first.
template <class Problem, class Sweep>
SweepSums<typename Problem::Number> sweep_ranges(Problem& problem, SweepOrder order,
                                                 const Sweep& sweep) {
  SweepSums<typename Problem::Number> sums{};
  const std::size_t phases = problem.contacts.shares.phases();
  for (std::size_t k = 0; k < phases; ++k) {
    const std::size_t phase = order == SweepOrder::forward ? k : phases - 1 - k;
    sums = joined(sums, work_in_phase(problem, phase, [&](const RowPart& part) {
                    return sweep_part(problem, part, sweep);
                  }));
  }
  return sums;
}

/// Calls work(first, count) for `size` items, part by part.
template <class Work>
void visit_items(const ParallelFor& loop, std::size_t size, const Work& work) {
  constexpr std::size_t items_of_part = 8192;
  parallel_for(loop, size / items_of_part + 1, [&](std::size_t part) {
    const std::size_t first = part * items_of_part;
    work(first, std::min(items_of_part, size - first));
  });
}

/// The same for all records of motion.
template <class Problem, class Work>
void visit_records(const Problem& problem, const Work& work) {
  visit_items(problem.loop, problem.motion.free.size(), work);
}

template <class Item>
void copy_items(const ParallelFor& loop, const std::vector<Item>& from, std::vector<Item>& to) {
  to.resize(from.size());
  visit_items(loop, from.size(), [&](std::size_t first, std::size_t count) {
    std::copy_n(from.data() + first, count, to.data() + first);
  });
}

template <class Problem>
using Motion = std::vector<Record<typename Problem::Number>>;

/// u = free + M^-1 pushes; the pushes are empty then.
template <class Problem>
void take_pushes(Problem& problem, Motion<Problem>& u) {
  auto& motion = problem.motion;
  visit_records(problem, [&](std::size_t first, std::size_t count) {
    problem.record_kernels.take_pushes(motion.free.data() + first, count,
                                       motion.pushes.data() + first, u.data() + first);
  });
}

/// u = free + M^-1 H p, without the rounding that sweeps have gathered.
template <class Problem>
void sum_motion(Problem& problem, Motion<Problem>& u) {
  using Real = typename Problem::Number;
  sweep_ranges(problem, SweepOrder::forward, [&](BlockRange range) {
    problem.kernels.add_pushes(problem.rows(range), range.blocks, problem.impulse(range),
                               problem.motion.pushes.data());
    return SweepSums<Real>{};
  });
  take_pushes(problem, u);
}
template <class Problem>
void set_motion(Problem& problem) {
  sum_motion(problem, problem.motion.u);
}

template <class Problem>
double true_residual(Problem& problem, double unit_mass) {
  using Real = typename Problem::Number;
  const SweepSums<Real> sums =
      sweep_ranges(problem, SweepOrder::forward, [&](BlockRange range) -> SweepSums<Real> {
        return {problem.kernels.residual(problem.rows(range), range.blocks, problem.motion.u.data(),
                                         problem.impulse(range), static_cast<Real>(unit_mass)),
                Real(0)};
      });
  return static_cast<double>(sums.residual);
}

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

 private:
  double theta_ = 1.0;
};

// Each method below improves the impulses by `iterate`, which returns the residual that its sweeps
// saw on the way, ends what it has begun by `finish`, and starts afresh from the impulses and their
// motion by `restart`.

/// Descent with Nesterov's momentum. `Sweeps` makes one sweep from the extrapolated impulses and
/// their motion by `descend`, and the next ones safer by `slow_down`.
template <class Problem, class Sweeps>
class Accelerated {
 public:
  static constexpr int sweeps = 1;
  explicit Accelerated(Problem& problem) : problem_(problem), sweeps_(problem) {}

  void restart() {
    copy_items(problem_.loop, problem_.contacts.impulse, problem_.contacts.extrapolated);
    sweeps_.restart();
    momentum_.restart();
  }
  void finish() { sweeps_.finish(); }
  double iterate() {
    const auto sums = sweeps_.descend(momentum_.next());
    if (sums.uphill > 0) {
      momentum_.restart();
    }
    const auto seen = static_cast<double>(sums.residual);
    first_seen_ = first_seen_ < 0.0 ? seen : first_seen_;
    if (seen > diverged * first_seen_) {
      begin_again();
    }
    return seen;
  }

 private:
  /// A descent has diverged when its residual is so many times the first; others rise less than
  /// tenfold.
  static constexpr double diverged = 100.0;

  /// From no impulses at all.
  void begin_again() {
    sweeps_.slow_down();
    first_seen_ = -1.0;
    auto& p = problem_.contacts.impulse;
    std::fill(p.begin(), p.end(), typename Problem::Number(0));
    set_motion(problem_);
    restart();
  }

  Problem& problem_;
  Sweeps sweeps_;
  Momentum momentum_;
  double first_seen_ = -1.0;  ///< residual at the begin of the descent; none yet if negative
};

/// Projected gradients of the dual, each step scaled by the diagonal.
template <class Problem>
class GradientSweeps {
  using Real = typename Problem::Number;

 public:
  explicit GradientSweeps(Problem& problem) : problem_(problem) {}

  void restart() {}
  void finish() {}
  SweepSums<Real> descend(double momentum) {
    const auto inverse_bound = static_cast<Real>(1.0 / bound_);
    MotionColumns<Real>& motion = problem_.motion;
    const SweepSums<Real> sums = sweep_ranges(problem_, SweepOrder::forward, [&](BlockRange range) {
      return problem_.kernels.gradient_sweep(problem_.rows(range), range.blocks, motion.u.data(),
                                             motion.pushes.data(), problem_.impulse(range),
                                             problem_.extrapolated(range), inverse_bound,
                                             static_cast<Real>(momentum));
    });
    take_pushes(problem_, motion.u);
    return sums;
  }
  /// Grains that overlap deeply, as at a random start, may have more contacts than the eigenvalue's
  /// bound was found for: steps half as long.
  void slow_down() { bound_ *= 2.0; }

 private:
  Problem& problem_;
  double bound_ = Problem::eigenvalue_bound;
};

/// Projected Gauss-Seidel sweeps: what a sweep changed, in impulses and in motion, is gone on with
/// before the next one. A sweep sees each row after those before it have moved, which is worth
/// nearly three gradients.
///
/// Of a large bed, sweeps go through the two phases in turn forward and backward: the last phase of
/// a sweep is the first one of the next. There each part ends the one sweep, goes on with its
/// grains' motion and begins the next sweep while its rows are at hand: they are read from memory
/// once for both.
template <class Problem>
class GaussSeidelSweeps {
  using Real = typename Problem::Number;

 public:
  explicit GaussSeidelSweeps(Problem& problem) : problem_(problem) {}

  void restart() {
    copy_items(problem_.loop, problem_.motion.u, problem_.motion.before);
    problem_.motion.summed.resize(problem_.motion.u.size());
    begun_.reset();
  }
  /// Of a large bed, begins a sweep and ends the one before, if one was begun.
  SweepSums<Real> descend(double wanted) {
    const auto momentum = static_cast<Real>(has_momentum_ ? wanted : 0.0);
    const SweepRule<Real> rule{static_cast<Real>(relaxation), momentum, false};
    const SweepSums<Real> sums =
        problem_.contacts.shares.phases() == 2 ? turn(rule) : whole_sweep(rule);
    if (++swept_ % sweeps_of_a_sum == 0) {
      finish();
      sum_up();
    }
    return sums;
  }
  void finish() {
    if (begun_) {
      work_in_phase(problem_, phase_, [&](const RowPart& part) { return end(part); });
      begun_.reset();
    }
  }
  /// Sweeps without momentum always go down.
  void slow_down() { has_momentum_ = false; }

 private:
  /// A sweep is no gradient step, its matrix is not symmetric: from 1.1 on momentum makes beds of
  /// spheres diverge; between .8 and 1.05 they need equally many sweeps.
  static constexpr double relaxation = 0.9;
  /// After so many sweeps the motion is summed up anew: momentum multiplies what rounding adds.
  static constexpr int sweeps_of_a_sum = 32;

  SweepSums<Real> sweep(BlockRange range, const SweepRule<Real>& rule) {
    return problem_.kernels.gauss_seidel_sweep(problem_.rows(range), range.blocks,
                                               problem_.motion.u.data(), problem_.impulse(range),
                                               problem_.extrapolated(range), rule);
  }
  SweepSums<Real> whole_sweep(const SweepRule<Real>& rule) {
    const SweepSums<Real> sums = sweep_ranges(problem_, SweepOrder::forward,
                                              [&](BlockRange range) { return sweep(range, rule); });
    MotionColumns<Real>& motion = problem_.motion;
    visit_records(problem_, [&](std::size_t first, std::size_t count) {
      problem_.record_kernels.extrapolate(rule.momentum, count, motion.before.data() + first,
                                          motion.u.data() + first);
    });
    return sums;
  }

  /// Ends the sweep that was begun and begins the next one in one phase; the other phase is the
  /// next to turn in.
  SweepSums<Real> turn(const SweepRule<Real>& next) {
    const SweepSums<Real> sums = work_in_phase(problem_, phase_, [&](const RowPart& part) {
      const SweepSums<Real> ended = begun_ ? end(part) : SweepSums<Real>{};
      return joined(ended, begin(part, next));
    });
    phase_ = 1 - phase_;
    begun_ = next;
    return sums;
  }
  SweepSums<Real> begin(const RowPart& part, const SweepRule<Real>& rule) {
    return sweep_part(problem_, part, [&](BlockRange range) { return sweep(range, rule); });
  }
  /// With its rows the part's grains are all swept: theirs are of the part or of the other phase.
  SweepSums<Real> end(const RowPart& part) {
    const SweepSums<Real> sums = begin(part, *begun_);
    const std::int32_t* const grain = problem_.contacts.shares.grains.data() + part.first_grain;
    Record<Real>* const before = problem_.motion.before.data();
    Record<Real>* const u = problem_.motion.u.data();
    for (std::size_t k = 0; k < part.grains; ++k) {
      go_on(begun_->momentum, before[grain[k]], u[grain[k]]);
    }
    return sums;
  }

  /// As RowKernels::extrapolate, one record.
  static void go_on(Real momentum, Record<Real>& before, Record<Real>& u) {
    const Record<Real> here = u, last = before;
    u = {here.x + momentum * (here.x - last.x), here.y + momentum * (here.y - last.y),
         here.z + momentum * (here.z - last.z), here.w + momentum * (here.w - last.w)};
    before = here;
  }

  /// Frees the motion of the impulses from what rounding has added, and the extrapolated one from
  /// the same: what lies between them is small, and is known better than either.
  void sum_up() {
    MotionColumns<Real>& motion = problem_.motion;
    sum_motion(problem_, motion.summed);
    visit_records(problem_, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        const Record<Real>&right = motion.summed[i], &wrong = motion.before[i];
        motion.u[i].x += right.x - wrong.x;
        motion.u[i].y += right.y - wrong.y;
        motion.u[i].z += right.z - wrong.z;
      }
    });
    motion.before.swap(motion.summed);
  }

  Problem& problem_;
  bool has_momentum_ = true;
  int swept_ = 0;
  std::size_t phase_ = 0;                 ///< to turn in, of a large bed
  std::optional<SweepRule<Real>> begun_;  ///< what the sweep begun in the other phase goes by
};

/// Projected Gauss-Seidel: sweeps forward, or forward and backward in turn.
template <class Problem>
class GaussSeidel {
  using Real = typename Problem::Number;

 public:
  static constexpr int sweeps = 1;
  GaussSeidel(Problem& problem, bool symmetric) : problem_(problem), symmetric_(symmetric) {}

  void restart() { backward_ = false; }
  void finish() {}
  double iterate() {
    const SweepRule<Real> rule{Real(1), Real(0), backward_};
    const SweepSums<Real> sums = sweep_ranges(
        problem_, backward_ ? SweepOrder::backward : SweepOrder::forward, [&](BlockRange range) {
          return problem_.kernels.gauss_seidel_sweep(
              problem_.rows(range), range.blocks, problem_.motion.u.data(), problem_.impulse(range),
              problem_.impulse(range), rule);
        });
    backward_ = symmetric_ && !backward_;
    return static_cast<double>(sums.residual);
  }

 private:
  Problem& problem_;
  bool symmetric_;
  bool backward_ = false;
};

/// Nonsmooth nonlinear conjugate gradients (Silcowitz, Niebe and Erleben 2010): what a symmetric
/// sweep changes is the negative gradient of a descent; Fletcher and Reeves' rule joins it to the
/// last direction.
template <class Problem>
class ConjugateGradient {
  using Real = typename Problem::Number;

 public:
  static constexpr int sweeps = 2;
  explicit ConjugateGradient(Problem& problem) : problem_(problem), sweep_(problem, true) {}

  void restart() {
    direction_.assign(problem_.contacts.impulse.size(), Real(0));
    squared_ = 0.0;
    sweep_.restart();
  }
  void finish() {}
  double iterate() {
    before_ = problem_.contacts.impulse;
    const double residual = sweep_.iterate();
    sweep_.iterate();
    const double squared = change_squared();
    const double carried = squared_ > 0.0 && squared <= squared_ ? squared / squared_ : 0.0;
    squared_ = squared;
    carry(static_cast<Real>(carried));
    return residual;
  }

 private:
  double change_squared() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < before_.size(); ++k) {
      const double change = static_cast<double>(problem_.contacts.impulse[k] - before_[k]);
      sum += change * change;
    }
    return sum;
  }
  /// Adds `share` of the last direction to the impulses and their motion; the next direction is
  /// that and what the sweeps changed. The next sweep projects.
  void carry(Real share) {
    std::vector<Real>& p = problem_.contacts.impulse;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Real carried = share * direction_[k];
      direction_[k] = carried + (p[k] - before_[k]);
      p[k] += carried;
    }
    if (share > Real(0)) {
      set_motion(problem_);
    }
  }

  Problem& problem_;
  GaussSeidel<Problem> sweep_;
  std::vector<Real> direction_, before_;
  double squared_ = 0.0;
};

/// Makes impulses that a method may have left negative admissible.
template <class Real>
void project(std::vector<Real>& p) {
  for (Real& value : p) {
    value = value < Real(0) ? Real(0) : value;
  }
}

/// Iterates until the true residual is below the tolerance or the sweeps are used up. The residual
/// seen by a sweep only says when to look: the next time when it has fallen by as much as the true
/// one was found to miss.
template <class Problem, class Method>
SolveReport run(const SolveLimits& limits, Problem& problem, Method method) {
  SolveReport report;
  double worth_a_look = limits.tolerance;
  std::int64_t most = limits.iterations;
  bool is_done = false;
  set_motion(problem);
  method.restart();
  while (!is_done) {
    const double seen = method.iterate();
    report.iterations += Method::sweeps;
    const bool is_spent = report.iterations + Method::sweeps > most;
    if (is_spent || seen <= worth_a_look) {
      method.finish();
      project(problem.contacts.impulse);
      set_motion(problem);
      report.residual = true_residual(problem, limits.unit_mass);
      const bool may_go_on = report.residual > limits.bearable && most < limits.patience;
      is_done = report.residual <= limits.tolerance || (is_spent && !may_go_on);
      most *= is_spent ? 2 : 1;
      worth_a_look = std::min(seen, worth_a_look) * limits.tolerance / report.residual;
      method.restart();
    }
  }
  return report;
}

template <class Problem>
SolveReport run_solver(const SolveLimits& limits, Problem problem) {
  using Real = typename Problem::Number;
  problem.motion.u.resize(problem.motion.free.size());
  problem.motion.pushes.assign(problem.motion.free.size(), {Real(0), Real(0), Real(0), Real(0)});
  switch (limits.solver) {
    case Solver::projected_gauss_seidel:
      return run(limits, problem, GaussSeidel<Problem>(problem, false));
    case Solver::symmetric_gauss_seidel:
      return run(limits, problem, GaussSeidel<Problem>(problem, true));
    case Solver::nonsmooth_nonlinear_conjugate:
      return run(limits, problem, ConjugateGradient<Problem>(problem));
    case Solver::accelerated_projected_gradient:
      return run(limits, problem, Accelerated<Problem, GradientSweeps<Problem>>(problem));
    case Solver::accelerated_gauss_seidel:
      break;
  }
  return run(limits, problem, Accelerated<Problem, GaussSeidelSweeps<Problem>>(problem));
}

}  // namespace

template <class Real>
SolveReport solve(const SolveLimits& limits, const ExecutionContext& context,
                  Contacts<Real>& contacts, MotionColumns<Real>& motion) {
  const RowKernels<Real>& kernels = row_kernels<Real>(context.kernels);
  return run_solver(limits,
                    SphereProblem<Real>{{kernels, kernels, context.loop, contacts, motion}});
}

template <class Real>
SolveReport solve(const SolveLimits& limits, const ExecutionContext& context,
                  LeverColumns<Real>& contacts, MotionColumns<Real>& motion) {
  return run_solver(limits, LeverProblem<Real>{{lever_kernels<Real>(context.kernels),
                                                row_kernels<Real>(context.kernels), context.loop,
                                                contacts, motion}});
}

template SolveReport solve(const SolveLimits&, const ExecutionContext&, Contacts<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, Contacts<double>&,
                           MotionColumns<double>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, LeverColumns<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const ExecutionContext&, LeverColumns<double>&,
                           MotionColumns<double>&);

}  // namespace grainsweep
