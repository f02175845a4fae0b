#include "engine/dynamics/solve.hpp"

#include <cmath>

namespace grainsweep {

namespace {

/// Upper bound of the largest eigenvalue of A scaled by its diagonal; 3.3 is the largest seen in any
/// bed of spheres.
constexpr double eigenvalue_bound = 3.95;

/// u = free + M^-1 H p.
template <class Real>
void set_motion(const Kernels& kernels, const Contacts<Real>& contacts, const std::vector<Real>& p,
                MotionColumns<Real>& motion) {
  motion.u = motion.free;
  row_kernels<Real>(kernels).apply_impulses(contacts.rows.data(), contacts.rows.size(), p.data(),
                                            motion.u.data());
}

template <class Real>
double residual_of(const Kernels& kernels, const Contacts<Real>& contacts,
                   const MotionColumns<Real>& motion) {
  return static_cast<double>(row_kernels<Real>(kernels).residual(
      contacts.rows.data(), contacts.rows.size(), motion.u.data(), contacts.impulse.data()));
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

template <class Real>
SolveReport accelerated_projected_gradient(const SolveLimits& limits, const Kernels& kernels,
                                           Contacts<Real>& contacts, MotionColumns<Real>& motion) {
  const RowKernels<Real>& sweep = row_kernels<Real>(kernels);
  constexpr auto inverse_bound = static_cast<Real>(1.0 / eigenvalue_bound);
  SolveReport report;
  Momentum momentum;
  contacts.extrapolated = contacts.impulse;
  set_motion(kernels, contacts, contacts.impulse, motion);
  while (report.iterations < limits.iterations) {
    motion.next = motion.free;
    const SweepSums<Real> sums = sweep.gradient_sweep(
        contacts.rows.data(), contacts.rows.size(), motion.u.data(), motion.next.data(),
        contacts.impulse.data(), contacts.extrapolated.data(), inverse_bound,
        static_cast<Real>(momentum.next()));
    std::swap(motion.u, motion.next);
    ++report.iterations;
    if (static_cast<double>(sums.residual) <= limits.tolerance) {
      break;
    }
    if (sums.uphill > Real(0)) {
      momentum.restart();
    }
  }
  set_motion(kernels, contacts, contacts.impulse, motion);
  report.residual = residual_of(kernels, contacts, motion);
  return report;
}

template <class Real>
SolveReport gauss_seidel(const SolveLimits& limits, const Kernels& kernels,
                         Contacts<Real>& contacts, MotionColumns<Real>& motion) {
  const RowKernels<Real>& sweep = row_kernels<Real>(kernels);
  const bool symmetric = limits.solver == Solver::symmetric_gauss_seidel;
  SolveReport report;
  set_motion(kernels, contacts, contacts.impulse, motion);
  while (report.iterations < limits.iterations) {
    const bool backward = symmetric && report.iterations % 2 == 1;
    const SweepSums<Real> sums =
        sweep.gauss_seidel_sweep(contacts.rows.data(), contacts.rows.size(), motion.u.data(),
                                 contacts.impulse.data(), backward);
    ++report.iterations;
    if (static_cast<double>(sums.residual) <= limits.tolerance) {
      break;
    }
  }
  set_motion(kernels, contacts, contacts.impulse, motion);
  report.residual = residual_of(kernels, contacts, motion);
  return report;
}

}  // namespace

template <class Real>
SolveReport solve(const SolveLimits& limits, const Kernels& kernels, Contacts<Real>& contacts,
                  MotionColumns<Real>& motion) {
  if (limits.solver == Solver::accelerated_projected_gradient) {
    return accelerated_projected_gradient(limits, kernels, contacts, motion);
  }
  return gauss_seidel(limits, kernels, contacts, motion);
}

template SolveReport solve(const SolveLimits&, const Kernels&, Contacts<float>&,
                           MotionColumns<float>&);
template SolveReport solve(const SolveLimits&, const Kernels&, Contacts<double>&,
                           MotionColumns<double>&);

}  // namespace grainsweep
