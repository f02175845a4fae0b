#include "engine/dynamics/step.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/changes.hpp"
#include "engine/dynamics/columns.hpp"

namespace grainsweep {

namespace {

// ---- what the kinds of grains do in their own way ----

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

/// Inverse inertia of a grain, 1/m.
double inverse_inertia(const Grains& bed, std::size_t grain) {
  return bed.inverse_inertia(static_cast<std::int32_t>(grain));
}

/// u_free = alpha u_last + g dt^2, clamped, of a grain; the weight of one that is lighter than its
/// mass accelerates it by as much more.
template <class Real>
void set_free_motion(const StepSettings& settings, const SphereBed& bed, std::size_t i,
                     std::vector<Record<Real>>& free) {
  const Record<double>& last = bed.motion[i];
  const double x = settings.momentum * last.x, y = settings.momentum * last.y;
  const double of_inertia = inverse_inertia(bed, i);
  const double z = settings.momentum * last.z - settings.dt * settings.dt * (of_inertia / last.w);
  const double length = std::sqrt(x * x + y * y + z * z);
  const double keep = length > settings.longest_free ? settings.longest_free / length : 1.0;
  free[i] = {static_cast<Real>(keep * x), static_cast<Real>(keep * y), static_cast<Real>(keep * z),
             static_cast<Real>(of_inertia)};
}
template <class Real>
void set_free_motion(const StepSettings& settings, const PolyhedronBed& bed, std::size_t i,
                     std::vector<Record<Real>>& free) {
  const double of_inertia = inverse_inertia(bed, i);
  const Vector drop(0.0, 0.0, -settings.dt * settings.dt * (of_inertia / bed.motion[i].w));
  const Vector v = settings.momentum * vector_of(bed.motion[i]) + drop;
  const Vector angles =
      clamped(settings.momentum * bed.spin[i], settings.longest_free / bed.circumradius(i));
  free[2 * i] = record<Real>(clamped(v, settings.longest_free), of_inertia);
  free[2 * i + 1] = record<Real>(bed.root_inertia[i].cwiseProduct(angles), 1.0);
}

void stand_still(Grains& bed, std::size_t grain) {
  bed.motion[grain] = {0.0, 0.0, 0.0, bed.motion[grain].w};
}
void stand_still(PolyhedronBed& bed, std::size_t grain) {
  stand_still(static_cast<Grains&>(bed), grain);
  bed.spin[grain] = Vector::Zero();
}

/// Moves a grain by `u`, cut at `most`.
template <class Real>
void advance(const std::vector<Record<Real>>& u, double most, std::size_t i, SphereBed& bed,
             Moved& moved) {
  double x = static_cast<double>(u[i].x), y = static_cast<double>(u[i].y);
  double z = static_cast<double>(u[i].z);
  double squared = x * x + y * y + z * z;
  if (squared > most * most) {
    const double keep = most / std::sqrt(squared);
    x *= keep, y *= keep, z *= keep;
    squared = most * most;
  }
  bed.position[i].x += x;
  bed.position[i].y += y;
  bed.position[i].z += z;
  bed.motion[i].x = x;
  bed.motion[i].y = y;
  bed.motion[i].z = z;
  moved.energy += squared / bed.motion[i].w;
  moved.longest = std::max(moved.longest, std::sqrt(squared));
}
template <class Real>
void advance(const std::vector<Record<Real>>& u, double most, std::size_t i, PolyhedronBed& bed,
             Moved& moved) {
  const Vector& root = bed.root_inertia[i];
  const Vector displacement = clamped(vector_of(u[2 * i]), most);
  const Vector angles =
      clamped(vector_of(u[2 * i + 1]).cwiseQuotient(root), most / bed.circumradius(i));
  move_grain(bed, i, displacement, angles);
  moved.energy += displacement.squaredNorm() / bed.motion[i].w +
                  bed.lightness_of(i) * root.cwiseProduct(angles).squaredNorm();
  const double longest = std::max(displacement.norm(), angles.norm() * bed.circumradius(i));
  moved.longest = std::max(moved.longest, longest);
  moved.of_inradius = std::max(moved.of_inradius, longest / bed.inradius(i));
}

/// Pairs that are near become rows, or candidates of contacts.
template <class Real>
void find_near(const StepSettings& settings, const ExecutionContext& context, SphereBed& bed,
               StepState<Sphere, Real>& state) {
  renew_rows(settings.near, settings.near + settings.margin, context, bed, state.candidates,
             state.contacts);
}
template <class Real>
void find_near(const StepSettings& settings, const ExecutionContext& context, PolyhedronBed& bed,
               StepState<Polyhedron, Real>& state) {
  if (renew_candidates(settings.near, settings.margin, context, bed, state.candidates)) {
    take_candidates(bed, state.candidates, state.contacts, context.loop);
  }
}
/// Nothing turns spheres.
template <class Real>
void hold_turning(const SphereContacts<Real>&, const ParallelFor&, SphereBed&) {}
void release_turning(const ParallelFor&, SphereBed&) {}

/// Rows with the gaps and normals of the grains where they are; see StepReport::sunk.
template <class Real>
double update_contacts(const StepSettings& settings, const ExecutionContext& context,
                       const SphereBed& bed, SphereContacts<Real>& contacts) {
  return update_gaps(bed, context, settings.correction, contacts);
}
template <class Real>
double update_contacts(const StepSettings& settings, const ExecutionContext& context,
                       const PolyhedronBed& bed, PolyhedronContacts<Real>& contacts) {
  return find_contacts(touch_settings(settings.near, bed.longest_drop(settings.dt)),
                       settings.correction, bed, context, contacts);
}

void scale_motion(double ratio, SphereBed& bed) {
  for (Record<double>& m : bed.motion) m = {ratio * m.x, ratio * m.y, ratio * m.z, m.w};
}
void scale_motion(double ratio, PolyhedronBed& bed) {
  for (Record<double>& m : bed.motion) m = {ratio * m.x, ratio * m.y, ratio * m.z, m.w};
  for (Vector& spin : bed.spin) spin *= ratio;
}

/// Rows of spheres are laid out for the steps they were listed for.
void forget_list(const SphereBed&, Candidates& candidates) { candidates.is_listed = false; }
void forget_list(const PolyhedronBed&, Candidates&) {}

// ---- the same for all ----

/// Free motion of all grains; nothing moves the entries that are not grains.
template <class Kind, class Real>
void set_free_motion(const StepSettings& settings, const ParallelFor& loop, const Bed<Kind>& bed,
                     MotionColumns<Real>& motion) {
  constexpr std::size_t records = Contacts<Kind, Real>::records_of_grain;
  std::vector<Record<Real>>& free = motion.free;
  motion.first_moving = records * bed.first_awake;
  free.resize(records * bed.position.size());
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange grains) {
    for (std::size_t i = grains.first; i < grains.last; ++i) {
      if (bed.is_asleep(i)) {
        std::fill_n(free.begin() + static_cast<std::ptrdiff_t>(records * i), records,
                    Record<Real>{Real(0), Real(0), Real(0), Real(0)});
      } else {
        set_free_motion(settings, bed, i, free);
      }
    }
  });
  for (std::size_t i = records * bed.grains(); i < free.size(); ++i) {
    free[i] = {Real(0), Real(0), Real(0), static_cast<Real>(bed.motion[i / records].w)};
  }
}

/// Moves some grains, none by more than `most`.
template <class Kind, class Real>
Moved advance(const MotionColumns<Real>& motion, double most, IndexRange grains, Bed<Kind>& bed) {
  constexpr std::size_t records = Contacts<Kind, Real>::records_of_grain;
  Moved moved;
  for (std::size_t i = grains.first; i < grains.last; ++i) {
    if (bed.is_asleep(i)) {
      stand_still(bed, i);
      continue;
    }
    advance(motion.u, most, i, bed, moved);
    const Real lift = motion.u[records * i].z - motion.free[records * i].z;
    moved.lift += static_cast<double>(lift) / inverse_inertia(bed, i);
    moved.mass += 1.0 / bed.motion[i].w;
    moved.awake += 1.0;
  }
  return moved;
}

/// Moves all grains and reports how they moved.
template <class Kind, class Real>
void advance(const StepSettings& settings, const ParallelFor& loop, Bed<Kind>& bed,
             StepState<Kind, Real>& state, StepReport& report) {
  state.moved.resize(bed.subdomains);
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t part, IndexRange some) {
    state.moved[part] = advance(state.motion, settings.longest, some, bed);
  });
  Moved all;
  for (const Moved& some : state.moved) {
    all = {all.energy + some.energy, std::max(all.longest, some.longest),
           all.lift + some.lift,     all.mass + some.mass,
           all.awake + some.awake,   std::max(all.of_inradius, some.of_inradius)};
  }
  const double dt = settings.dt;
  report.kinetic_energy = all.energy / (2.0 * dt * dt * std::max(all.awake, 1.0));
  report.mean_motion = all.mass > 0.0 ? std::sqrt(all.energy / all.mass) : 0.0;
  report.largest_motion = all.longest;
  report.motion_of_inradius = all.of_inradius;
  report.carried = all.mass > 0.0 ? all.lift / (dt * dt * all.mass) : 1.0;
}

/// Impulses begin such that they carry a tall bed; in a high bed their changes are solved for.
template <class Kind, class Real>
SolveReport solve_rows(const StepSettings& settings, const SolveLimits& limits,
                       const ExecutionContext& context, const Bed<Kind>& bed,
                       StepState<Kind, Real>& state) {
  if constexpr (std::is_same_v<Kind, Sphere>) {
    if (settings.carries && is_tall(bed)) {
      carry_weight(settings.dt, bed, state.contacts);
      if (std::is_same_v<Real, float> && is_high(bed)) {
        return solve_changes(limits, context, state.contacts, state.motion);
      }
    }
  }
  return solve(limits, context, state.contacts, state.motion);
}

/// Solves the rows as they are and moves all grains.
template <class Kind, class Real>
void move_on_contacts(const StepSettings& settings, const ExecutionContext& context, Bed<Kind>& bed,
                      StepState<Kind, Real>& state, StepReport& report) {
  const double force_unit = settings.dt * settings.dt;  // impulse of 1 m g over the step
  SolveLimits limits = settings.limits;
  limits.tolerance *= force_unit;
  limits.rms_tolerance *= force_unit;
  const int iterations = report.solve.iterations;
  set_free_motion(settings, context.loop, bed, state.motion);
  report.solve = solve_rows(settings, limits, context, bed, state);
  report.solve.iterations += iterations;
  report.spurious_path += report.solve.rms * report.solve.loaded /
                          static_cast<double>(std::max<std::int64_t>(degrees_of_freedom(bed), 1));
  report.solve.residual /= force_unit;
  report.solve.rms /= force_unit;
  advance(settings, context.loop, bed, state, report);
  ++report.steps;
}

/// Gaps of the contacts as they are after the last motion.
template <class Real>
void move_gaps(double correction, const ExecutionContext& context,
               StepState<Polyhedron, Real>& state) {
  visit_ranges(state.contacts.shares, context.loop, [&](BlockRange range) {
    state.contacts.move_gaps(context.kernels, range, state.motion.u.data(), correction);
  });
}

}  // namespace

template <class Kind, class Real>
StepReport step(const StepSettings& settings, const ExecutionContext& context, Bed<Kind>& bed,
                StepState<Kind, Real>& state) {
  StepReport report;
  hold_turning(state.contacts, context.loop, bed);
  find_near(settings, context, bed, state);
  report.sunk = update_contacts(settings, context, bed, state.contacts);
  move_on_contacts(settings, context, bed, state, report);
  if constexpr (std::is_same_v<Kind, Polyhedron>) {
    while (report.steps < settings.steps && report.motion_of_inradius < longest_on_same_contacts) {
      move_gaps(settings.correction, context, state);
      move_on_contacts(settings, context, bed, state, report);
    }
  }
  release_turning(context.loop, bed);
  return report;
}

template <class Kind, class Real>
void change_step(double ratio, Bed<Kind>& bed, StepState<Kind, Real>& state) {
  forget_list(bed, state.candidates);
  scale_motion(ratio, bed);
  for (Real& impulse : state.contacts.impulse) impulse *= static_cast<Real>(ratio * ratio);
}

template StepReport step(const StepSettings&, const ExecutionContext&, SphereBed&,
                         StepState<Sphere, float>&);
template StepReport step(const StepSettings&, const ExecutionContext&, SphereBed&,
                         StepState<Sphere, double>&);
template StepReport step(const StepSettings&, const ExecutionContext&, PolyhedronBed&,
                         StepState<Polyhedron, float>&);
template StepReport step(const StepSettings&, const ExecutionContext&, PolyhedronBed&,
                         StepState<Polyhedron, double>&);
template void change_step(double, SphereBed&, StepState<Sphere, float>&);
template void change_step(double, SphereBed&, StepState<Sphere, double>&);
template void change_step(double, PolyhedronBed&, StepState<Polyhedron, float>&);
template void change_step(double, PolyhedronBed&, StepState<Polyhedron, double>&);

}  // namespace grainsweep
