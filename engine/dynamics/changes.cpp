#include "engine/dynamics/changes.hpp"

#include "engine/shape/convex_shape.hpp"

namespace grainsweep {

namespace {

template <class Real>
Vector normal_of(const RowBlock<Real>& row, std::size_t lane) {
  return {static_cast<double>(row.normal_x[lane]), static_cast<double>(row.normal_y[lane]),
          static_cast<double>(row.normal_z[lane])};
}

/// The motion of each grain with the impulses that the contacts hold.
template <class Real>
void set_motion_before(const ParallelFor& loop, SphereContacts<Real>& contacts,
                       MotionColumns<Real>& motion) {
  std::vector<Vector>& whole = motion.changed_from;
  whole.assign(motion.free.size(), Vector::Zero());
  visit_lanes(contacts, loop, [&](std::size_t block, std::size_t lane, std::size_t at) {
    if (contacts.impulse[at] == Real(0)) return;
    const RowBlock<Real>& row = contacts.rows[block];
    const Vector push = static_cast<double>(contacts.impulse[at]) * normal_of(row, lane);
    whole[static_cast<std::size_t>(row.a(lane))] -= push;
    whole[static_cast<std::size_t>(row.b(lane))] += push;
  });
  parallel_items(loop, whole.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const Record<Real>& free = motion.free[i];
      whole[i] = vector_of(free) + static_cast<double>(free.w) * whole[i];
    }
  });
}

/// What that motion leaves of the gaps; for a round wall, where it takes the centre.
template <class Real>
void move_gaps(const ParallelFor& loop, const std::vector<Vector>& by,
               SphereContacts<Real>& contacts) {
  const auto add = [](double change, Real& to) {
    to = static_cast<Real>(static_cast<double>(to) + change);
  };
  visit_lanes(contacts, loop, [&](std::size_t block, std::size_t lane, std::size_t) {
    RowBlock<Real>& row = contacts.rows[block];
    const Vector& a = by[static_cast<std::size_t>(row.a(lane))];
    if (block < contacts.first_round) {
      const Vector& b = by[static_cast<std::size_t>(row.b(lane))];
      add(normal_of(row, lane).dot(b - a), row.gap[lane]);
    } else if (block % 2 == contacts.first_round % 2) {
      RowBlock<Real>& along_y = contacts.rows[block + 1];
      const double x = static_cast<double>(row.gap[lane]),
                   y = static_cast<double>(along_y.gap[lane]);
      add(a.x() * (2.0 * x + a.x()) + a.y() * (2.0 * y + a.y()), along_y.reduced_mass[lane]);
      add(a.x(), row.gap[lane]);
      add(a.y(), along_y.gap[lane]);
    }
  });
}

}  // namespace

template <class Real>
SolveReport solve_changes(const SolveLimits& limits, const ExecutionContext& context,
                          SphereContacts<Real>& contacts, MotionColumns<Real>& motion) {
  set_motion_before(context.loop, contacts, motion);
  move_gaps(context.loop, motion.changed_from, contacts);
  contacts.changed_from.assign(contacts.impulse.size(), Real(0));
  contacts.changed_from.swap(contacts.impulse);
  motion.whole_free = motion.free;
  for (Record<Real>& free : motion.free) free = {Real(0), Real(0), Real(0), free.w};
  const SolveReport report = solve(limits, context, contacts, motion);
  motion.free.swap(motion.whole_free);
  parallel_items(context.loop, motion.u.size(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      const Vector& from = motion.changed_from[i];
      Record<Real>& u = motion.u[i];
      u = {static_cast<Real>(from.x() + static_cast<double>(u.x)),
           static_cast<Real>(from.y() + static_cast<double>(u.y)),
           static_cast<Real>(from.z() + static_cast<double>(u.z)), u.w};
    }
  });
  for (std::size_t at = 0; at < contacts.impulse.size(); ++at) {
    contacts.impulse[at] += contacts.changed_from[at];
  }
  contacts.changed_from.clear();
  return report;
}

template SolveReport solve_changes(const SolveLimits&, const ExecutionContext&,
                                   SphereContacts<float>&, MotionColumns<float>&);
template SolveReport solve_changes(const SolveLimits&, const ExecutionContext&,
                                   SphereContacts<double>&, MotionColumns<double>&);

}  // namespace grainsweep
