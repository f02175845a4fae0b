#include "engine/dynamics/shape_rest.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/narrow/constraints.hpp"

namespace grainsweep {

namespace {

/// Calls visit(k, force) for each contact of the last step whose force counts, m g.
template <class Real, class Visit>
void visit_force_bearing(const ShapeStepState<Real>& state, double dt, Visit visit) {
  for (std::size_t k = 0; k < state.contacts.contacts.size(); ++k) {
    double force = 0.0;
    for (std::size_t j = 0; j < state.contacts.contacts[k].count; ++j) {
      force += impulse_of(state, k, j) / (dt * dt);
    }
    if (force > least_force) visit(k, force);
  }
}

/// The two sides of each contact that bears a force, sorted.
using Sides = std::vector<std::pair<std::int32_t, std::int32_t>>;

template <class Real>
Sides force_bearing(const ShapeStepState<Real>& state, double dt) {
  Sides sides;
  visit_force_bearing(state, dt, [&](std::size_t k, double) {
    sides.emplace_back(state.contacts.contacts[k].a, state.contacts.contacts[k].b);
  });
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// What slides freely: see `certify`.
std::int64_t zero_modes(const PolyhedronBed& bed, const Sides& bearing) {
  std::vector<char> held(bed.grains(), 0), stands(bed.grains(), 0);
  for (const auto& [a, b] : bearing) {
    (b == bed.wall_name(0) ? stands : held)[static_cast<std::size_t>(a)] = 1;
    if (bed.is_grain(b)) held[static_cast<std::size_t>(b)] = 1;
  }
  std::int64_t lone = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) lone += stands[i] != 0 && held[i] == 0 ? 1 : 0;
  const bool has_cluster = std::find(held.begin(), held.end(), 1) != held.end();
  const int free_axes =
      (bed.box.x == Boundary::periodic ? 1 : 0) + (bed.box.y == Boundary::periodic ? 1 : 0);
  return 3 * lone + (has_cluster ? free_axes : 0);
}

}  // namespace

template <class Real>
RestReport certify(PolyhedronBed& bed, const ExecutionContext& context, double dt,
                   ShapeStepState<Real>& state) {
  constexpr double search_margin = 0.05;  // d; as in the steps, so that candidates last
  const Sides bearing = force_bearing(state, dt);
  TouchSettings touch = touch_settings(constraint_gap, dt);
  touch.of_depth = 0.0;  // overlaps as deep as they are
  ShapeContacts now;
  find_contacts({touch, search_margin}, context, bed, state.search, now);
  RestReport rest;
  std::int64_t pairs = 0;
  for (const ShapeContact& c : now.contacts) {
    if (!std::binary_search(bearing.begin(), bearing.end(), std::pair(c.a, c.b))) continue;
    const double depth = std::max(0.0, -least_gap(now.points.data() + c.first, c.count));
    rest.overlap_mean += depth;
    rest.overlap_max = std::max(rest.overlap_max, depth);
    rest.contacts += constraints_of(now.points.data() + c.first, c.count, constraint_gap);
    ++pairs;
  }
  rest.overlap_mean /= static_cast<double>(std::max<std::int64_t>(pairs, 1));
  rest.isostatic_contacts = 6 * static_cast<std::int64_t>(bed.grains()) - zero_modes(bed, bearing);
  return rest;
}

template <class Real>
double carried_weight(const PolyhedronBed& bed, const ShapeStepState<Real>& state, double dt) {
  double weight = 0.0, carried = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) weight += 1.0 / bed.motion[i].w;
  visit_force_bearing(state, dt, [&](std::size_t k, double force) {
    carried += state.contacts.contacts[k].b == bed.wall_name(0) ? force : 0.0;
  });
  return weight > 0.0 ? carried / weight : 1.0;
}

template <class Real>
std::vector<PairForce> pair_forces(const PolyhedronBed& bed, const ShapeStepState<Real>& state,
                                   double dt) {
  std::vector<PairForce> forces;
  visit_force_bearing(state, dt, [&](std::size_t k, double force) {
    const ShapeContact& c = state.contacts.contacts[k];
    if (!bed.is_grain(c.b)) return;
    const double height = (bed.position[static_cast<std::size_t>(c.a)].z +
                           bed.position[static_cast<std::size_t>(c.b)].z) /
                          2.0;
    const int constraints =
        constraints_of(state.contacts.points.data() + c.first, c.count, constraint_gap);
    forces.push_back({c.a, c.b, height, force, std::max(constraints, 1)});
  });
  return forces;
}

template <class Real>
std::vector<double> force_sums(const PolyhedronBed& bed, const ShapeStepState<Real>& state,
                               double dt) {
  std::vector<double> force(bed.grains(), 0.0);
  visit_force_bearing(state, dt, [&](std::size_t k, double magnitude) {
    const ShapeContact& c = state.contacts.contacts[k];
    force[static_cast<std::size_t>(c.a)] += magnitude;
    if (bed.is_grain(c.b)) force[static_cast<std::size_t>(c.b)] += magnitude;
  });
  return force;
}

template RestReport certify(PolyhedronBed&, const ExecutionContext&, double,
                            ShapeStepState<float>&);
template RestReport certify(PolyhedronBed&, const ExecutionContext&, double,
                            ShapeStepState<double>&);
template double carried_weight(const PolyhedronBed&, const ShapeStepState<float>&, double);
template double carried_weight(const PolyhedronBed&, const ShapeStepState<double>&, double);
template std::vector<PairForce> pair_forces(const PolyhedronBed&, const ShapeStepState<float>&,
                                            double);
template std::vector<PairForce> pair_forces(const PolyhedronBed&, const ShapeStepState<double>&,
                                            double);
template std::vector<double> force_sums(const PolyhedronBed&, const ShapeStepState<float>&, double);
template std::vector<double> force_sums(const PolyhedronBed&, const ShapeStepState<double>&,
                                        double);

}  // namespace grainsweep
