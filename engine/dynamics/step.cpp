#include "engine/dynamics/step.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

/// u_free = alpha u_last + g dt^2, clamped.
template <class Real>
void set_free_motion(const StepSettings& settings, const SphereBed& bed, IndexRange grains,
                     std::vector<Record<Real>>& free) {
  const double fall = settings.dt * settings.dt;
  for (std::size_t i = grains.first; i < grains.last; ++i) {
    const Record<double>& last = bed.motion[i];
    const double x = settings.momentum * last.x, y = settings.momentum * last.y;
    const double z = settings.momentum * last.z - fall;
    const double length = std::sqrt(x * x + y * y + z * z);
    const double keep = length > longest_free_motion ? longest_free_motion / length : 1.0;
    free[i] = {static_cast<Real>(keep * x), static_cast<Real>(keep * y),
               static_cast<Real>(keep * z), static_cast<Real>(last.w)};
  }
}
template <class Real>
void set_free_motion(const StepSettings& settings, const ParallelFor& loop, const SphereBed& bed,
                     std::vector<Record<Real>>& free) {
  free.resize(bed.motion.size());
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange grains) {
    set_free_motion(settings, bed, grains, free);
  });
  for (std::size_t i = bed.grains(); i < free.size(); ++i) {
    free[i] = {Real(0), Real(0), Real(0), static_cast<Real>(bed.motion[i].w)};
  }
}

/// Lists candidates and lays out rows anew if the list may have become incomplete.
template <class Real>
bool renew_candidates(const StepSettings& settings, const ExecutionContext& context, SphereBed& bed,
                      StepState<Real>& state) {
  const Balls balls{bed, bed.position};
  if (state.has_candidates && still_complete(balls, settings.near, state.candidates)) {
    return false;
  }
  wrap(bed, context.loop);
  find_candidates(balls, settings.near + settings.margin, context, state.candidates);
  lay_out(bed, state.candidates, state.contacts, context.loop);
  state.has_candidates = true;
  return true;
}

/// Moves some grains by `u`, cut at longest_motion.
template <class Real>
Moved advance(const std::vector<Record<Real>>& u, IndexRange grains, SphereBed& bed) {
  double energy = 0.0, longest = 0.0;
  for (std::size_t i = grains.first; i < grains.last; ++i) {
    double x = static_cast<double>(u[i].x), y = static_cast<double>(u[i].y);
    double z = static_cast<double>(u[i].z);
    double squared = x * x + y * y + z * z;
    if (squared > longest_motion * longest_motion) {
      const double keep = longest_motion / std::sqrt(squared);
      x *= keep, y *= keep, z *= keep;
      squared = longest_motion * longest_motion;
    }
    bed.position[i].x += x;
    bed.position[i].y += y;
    bed.position[i].z += z;
    bed.motion[i].x = x;
    bed.motion[i].y = y;
    bed.motion[i].z = z;
    energy += squared / bed.motion[i].w;
    longest = std::max(longest, squared);
  }
  return {energy, longest};
}

/// Moves all grains and reports how they moved.
template <class Real>
void advance(double dt, const ParallelFor& loop, SphereBed& bed, StepState<Real>& state,
             StepReport& report) {
  state.moved.resize(bed.subdomains);
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t part, IndexRange some) {
    state.moved[part] = advance(state.motion.u, some, bed);
  });
  Moved all;
  for (const Moved& some : state.moved) {
    all = {all.energy + some.energy, std::max(all.longest, some.longest)};
  }
  const double grains = static_cast<double>(std::max<std::size_t>(bed.grains(), 1));
  report.kinetic_energy = all.energy / (2.0 * dt * dt * grains);
  report.largest_motion = std::sqrt(all.longest);
}

}  // namespace

template <class Real>
StepReport step(const StepSettings& settings, const ExecutionContext& context, SphereBed& bed,
                StepState<Real>& state) {
  StepReport report;
  const double force_unit = settings.dt * settings.dt;  // impulse of 1 m g over the step
  SolveLimits limits = settings.limits;
  limits.tolerance *= force_unit;
  set_free_motion(settings, context.loop, bed, state.motion.free);
  report.searched = renew_candidates(settings, context, bed, state);
  report.sunk = detect(bed, context, settings.correction, state.contacts);
  report.solve = solve(limits, context, state.contacts, state.motion);
  report.solve.residual /= force_unit;
  advance(settings.dt, context.loop, bed, state, report);
  return report;
}

template <class Real>
void change_step(double ratio, SphereBed& bed, StepState<Real>& state) {
  state.has_candidates = false;
  for (Record<double>& m : bed.motion) m = {ratio * m.x, ratio * m.y, ratio * m.z, m.w};
  for (Real& impulse : state.contacts.impulse) impulse *= static_cast<Real>(ratio * ratio);
}

template StepReport step(const StepSettings&, const ExecutionContext&, SphereBed&,
                         StepState<float>&);
template StepReport step(const StepSettings&, const ExecutionContext&, SphereBed&,
                         StepState<double>&);

template void change_step(double, SphereBed&, StepState<float>&);
template void change_step(double, SphereBed&, StepState<double>&);

}  // namespace grainsweep
