#include "engine/dynamics/solve.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

/// What a solver works on: rows, their kernels, and the motion of their grains.
template <class Rows, class RowsKernels, class Real>
struct Work {
  using Number = Real;

  const RowsKernels& kernels;
  const RowKernels<Real>& record_kernels;  ///< for what is done to records, whatever the rows
  const PartLoop& loop;
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

/// Sums over all rows of what sweep(range) sees: the ranges of a phase at the same time, phase
/// after phase, or from the last phase to the first.
template <class Problem, class Sweep>
SweepSums<typename Problem::Number> sweep_ranges(Problem& problem, SweepOrder order,
                                                 const Sweep& sweep) {
  using Real = typename Problem::Number;
  const std::vector<BlockRange>& ranges = problem.contacts.ranges;
  std::vector<SweepSums<Real>>& seen = problem.motion.seen;
  seen.resize(ranges.size());
  const std::size_t phases = ranges.empty() ? 0 : ranges.back().phase + 1;
  for (std::size_t k = 0; k < phases; ++k) {
    const std::size_t phase = order == SweepOrder::forward ? k : phases - 1 - k;
    const auto begins = [](const BlockRange& range, std::size_t at) { return range.phase < at; };
    const auto first = std::lower_bound(ranges.begin(), ranges.end(), phase, begins);
    const auto last = std::lower_bound(first, ranges.end(), phase + 1, begins);
    const auto offset = static_cast<std::size_t>(first - ranges.begin());
    run_parts(problem.loop, static_cast<std::size_t>(last - first),
              [&](std::size_t part) { seen[offset + part] = sweep(ranges[offset + part]); });
  }
  SweepSums<Real> sums{Real(0), Real(0)};
  for (const SweepSums<Real>& one : seen) {
    sums = {std::max(sums.residual, one.residual), sums.uphill + one.uphill};
  }
  return sums;
}

/// Calls work(first, count) for all records of motion, part by part.
template <class Problem, class Work>
void visit_records(const Problem& problem, const Work& work) {
  constexpr std::size_t records_of_part = 8192;
  const std::size_t records = problem.motion.free.size();
  run_parts(problem.loop, records / records_of_part + 1, [&](std::size_t part) {
    const std::size_t first = part * records_of_part;
    work(first, std::min(records_of_part, records - first));
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
// saw on the way, and starts afresh from the impulses and their motion by `restart`.

/// Descent with Nesterov's momentum. `Sweeps` makes one sweep from the extrapolated impulses and
/// their motion by `descend`, and the next ones safer by `slow_down`.
template <class Problem, class Sweeps>
class Accelerated {
 public:
  static constexpr int sweeps = 1;
  explicit Accelerated(Problem& problem) : problem_(problem), sweeps_(problem) {}

  void restart() {
    problem_.contacts.extrapolated = problem_.contacts.impulse;
    sweeps_.restart();
    momentum_.restart();
  }
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
template <class Problem>
class GaussSeidelSweeps {
  using Real = typename Problem::Number;

 public:
  explicit GaussSeidelSweeps(Problem& problem) : problem_(problem) {}

  void restart() {
    problem_.motion.before = problem_.motion.u;
    problem_.motion.summed.resize(problem_.motion.u.size());
  }
  SweepSums<Real> descend(double wanted) {
    MotionColumns<Real>& motion = problem_.motion;
    const auto momentum = static_cast<Real>(has_momentum_ ? wanted : 0.0);
    const SweepRule<Real> rule{static_cast<Real>(relaxation), momentum, false};
    const SweepSums<Real> sums = sweep_ranges(problem_, SweepOrder::forward, [&](BlockRange range) {
      return problem_.kernels.gauss_seidel_sweep(problem_.rows(range), range.blocks,
                                                 motion.u.data(), problem_.impulse(range),
                                                 problem_.extrapolated(range), rule);
    });
    visit_records(problem_, [&](std::size_t first, std::size_t count) {
      problem_.record_kernels.extrapolate(momentum, count, motion.before.data() + first,
                                          motion.u.data() + first);
    });
    if (++swept_ % sweeps_of_a_sum == 0) {
      sum_up();
    }
    return sums;
  }
  /// Sweeps without momentum always go down.
  void slow_down() { has_momentum_ = false; }

 private:
  /// A sweep is no gradient step, its matrix is not symmetric: from 1.1 on momentum makes beds of
  /// spheres diverge; between .8 and 1.05 they need equally many sweeps.
  static constexpr double relaxation = 0.9;
  /// After so many sweeps the motion is summed up anew: momentum multiplies what rounding adds.
  static constexpr int sweeps_of_a_sum = 32;

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
};

/// Projected Gauss-Seidel: sweeps forward, or forward and backward in turn.
template <class Problem>
class GaussSeidel {
  using Real = typename Problem::Number;

 public:
  static constexpr int sweeps = 1;
  GaussSeidel(Problem& problem, bool symmetric) : problem_(problem), symmetric_(symmetric) {}

  void restart() { backward_ = false; }
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
SolveReport solve(const SolveLimits& limits, const Processor& processor, Contacts<Real>& contacts,
                  MotionColumns<Real>& motion) {
  const RowKernels<Real>& kernels = row_kernels<Real>(processor.kernels);
  return run_solver(limits,
                    SphereProblem<Real>{{kernels, kernels, processor.loop, contacts, motion}});
}

template <class Real>
SolveReport solve(const SolveLimits& limits, const Processor& processor,
                  LeverColumns<Real>& contacts, MotionColumns<Real>& motion) {
  return run_solver(limits, LeverProblem<Real>{{lever_kernels<Real>(processor.kernels),
                                                row_kernels<Real>(processor.kernels),
                                                processor.loop, contacts, motion}});
}

template SolveReport solve(const SolveLimits&, const Processor&, Contacts<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const Processor&, Contacts<double>&,
                           MotionColumns<double>&);
template SolveReport solve(const SolveLimits&, const Processor&, LeverColumns<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const Processor&, LeverColumns<double>&,
                           MotionColumns<double>&);

}  // namespace grainsweep
