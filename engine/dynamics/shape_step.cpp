#include "engine/dynamics/shape_step.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

// A face is preferred to edges that part a pair by no more than this share of g dt^2 beyond it, d;
// where less is preferred edges replace whole faces and the bed collapses.
constexpr double preferred_share = 0.5;
constexpr double least_preference = 1e-4;
constexpr double preferred_of_depth = 1.0;  // beyond its overlap

/// The vector, shortened to `longest`.
Vector clamped(const Vector& v, double longest) {
  const double length = v.norm();
  return length > longest ? Vector(longest / length * v) : v;
}

template <class Real>
Record<Real> record(const Vector& v, double w) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z()),
          static_cast<Real>(w)};
}
template <class Real>
Vector vector(const Record<Real>& r) {
  return {static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z)};
}

template <class Real>
void set_free_motion(const StepSettings& settings, const PolyhedronBed& bed,
                     std::vector<Record<Real>>& free) {
  free.assign(2 * bed.position.size(), {Real(0), Real(0), Real(0), Real(0)});
  const Vector fall(0.0, 0.0, -settings.dt * settings.dt);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Vector v = settings.momentum * vector(bed.motion[i]) + fall;
    const Vector angles =
        clamped(settings.momentum * bed.spin[i], longest_free_motion / bed.circumradius(i));
    free[2 * i] = record<Real>(clamped(v, longest_free_motion), bed.motion[i].w);
    free[2 * i + 1] = record<Real>(bed.root_inertia[i].cwiseProduct(angles), 1.0);
  }
}

/// Moves the grains by `u` and reports how they moved.
template <class Real>
void advance(const std::vector<Record<Real>>& u, double dt, PolyhedronBed& bed,
             StepReport& report) {
  double energy = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Vector displacement = vector(u[2 * i]), scaled_angles = vector(u[2 * i + 1]);
    const Vector angles = scaled_angles.cwiseQuotient(bed.root_inertia[i]);
    move_grain(bed, i, displacement, angles);
    energy += displacement.squaredNorm() / bed.motion[i].w + scaled_angles.squaredNorm();
    report.largest_motion =
        std::max({report.largest_motion, displacement.norm(), angles.norm() * bed.circumradius(i)});
  }
  const double grains = static_cast<double>(std::max<std::size_t>(bed.grains(), 1));
  report.kinetic_energy = energy / (2.0 * dt * dt * grains);
}

}  // namespace

TouchSettings touch_settings(double near, double dt) {
  return {near, std::max(least_preference, preferred_share * dt * dt), preferred_of_depth};
}

template <class Real>
StepReport step(const StepSettings& settings, const ExecutionContext& context, PolyhedronBed& bed,
                ShapeStepState<Real>& state) {
  StepReport report;
  const double force_unit = settings.dt * settings.dt;  // impulse of 1 m g over the step
  SolveLimits limits = settings.limits;
  limits.tolerance *= force_unit;
  set_free_motion(settings, bed, state.motion.free);
  remember_impulses(bed, state.contacts, state.places, state.rows, state.carried);
  report.searched = find_contacts({touch_settings(settings.near, settings.dt), settings.margin},
                                  context, bed, state.search, state.contacts);
  lay_out(bed, state.contacts, settings.correction, state.places, state.rows);
  carry_impulses(state.contacts, state.carried, state.places, state.rows);
  report.solve = solve(limits, context, state.rows, state.motion);
  report.solve.residual /= force_unit;
  advance(state.motion.u, settings.dt, bed, report);
  return report;
}

template <class Real>
void change_step(double ratio, PolyhedronBed& bed, ShapeStepState<Real>& state) {
  for (Record<double>& m : bed.motion) m = {ratio * m.x, ratio * m.y, ratio * m.z, m.w};
  for (Vector& spin : bed.spin) spin *= ratio;
  for (Real& impulse : state.rows.impulse) impulse *= static_cast<Real>(ratio * ratio);
}

template StepReport step(const StepSettings&, const ExecutionContext&, PolyhedronBed&,
                         ShapeStepState<float>&);
template StepReport step(const StepSettings&, const ExecutionContext&, PolyhedronBed&,
                         ShapeStepState<double>&);

template void change_step(double, PolyhedronBed&, ShapeStepState<float>&);
template void change_step(double, PolyhedronBed&, ShapeStepState<double>&);

}  // namespace grainsweep
