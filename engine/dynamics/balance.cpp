#include "engine/dynamics/balance.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/columns.hpp"

namespace grainsweep {

namespace {

/// Rows miss balance by no more than this, in weights of the lighter grain: beds of one size whose
/// best forces leave nothing are then reported to be out of balance by up to 0.003 on average.
constexpr double solved_to = 2e-4;
constexpr int most_sweeps = 4000;

/// A closed contact, by which one sphere lifts another.
struct Lift {
  std::size_t from, to;
};

/// Marks the grains that the floor lifts, and lists the contacts by which grains lift others.
std::vector<Lift> find_lifts(const SphereBed& bed, const SphereContacts<double>& closed,
                             std::vector<char>& is_held) {
  const auto height = [&](std::size_t grain) { return bed.position[grain].z; };
  std::vector<Lift> lifts;
  for (std::size_t block = 0; block < closed.rows.size(); ++block) {
    const RowBlock<double>& row = closed.rows[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (row.gap[lane] > 0.0 || row.normal_z[lane] == 0.0) continue;
      const auto a = static_cast<std::size_t>(row.a(lane));
      if (block >= closed.pair_blocks) {
        is_held[a] = 1;
        continue;
      }
      const auto b = static_cast<std::size_t>(row.b(lane));
      lifts.push_back(height(a) < height(b) ? Lift{a, b} : Lift{b, a});
    }
  }
  std::sort(lifts.begin(), lifts.end(), [&](const Lift& one, const Lift& other) {
    return height(one.from) < height(other.from);
  });
  return lifts;
}

/// Lower bound of the mean imbalance, due to the grains that stand on nothing.
double least_imbalance(const SphereBed& bed, const SphereContacts<double>& closed) {
  std::vector<char> is_held(bed.grains(), 0);
  for (const Lift& lift : find_lifts(bed, closed, is_held)) {
    if (is_held[lift.from] != 0) is_held[lift.to] = 1;
  }
  double falls = 0.0, heaviest = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double mass = 1.0 / bed.motion[i].w;
    falls += is_held[i] != 0 ? 0.0 : mass;
    heaviest = std::max(heaviest, mass);
  }
  return bed.grains() == 0 ? 0.0 : falls / (heaviest * static_cast<double>(bed.grains()));
}
/// For polyhedra it is not looked for.
double least_imbalance(const PolyhedronBed&, const PolyhedronContacts<double>&) { return 0.0; }

/// The accelerations of free fall.
template <class Kind>
void set_free_fall(const Bed<Kind>& bed, std::vector<Record<double>>& free) {
  constexpr std::size_t records = Contacts<Kind, double>::records_of_grain;
  free.resize(records * bed.position.size());
  for (std::size_t k = 0; k < free.size(); ++k) {
    const bool falls = k < records * bed.grains(), turns = falls && k % records > 0;
    free[k] = {0.0, 0.0, falls && !turns ? -1.0 : 0.0, turns ? 1.0 : bed.motion[k / records].w};
  }
}

/// Net force on a grain in its own weight, from its acceleration.
double net_force(const Record<double>& acceleration) {
  return std::hypot(acceleration.x, acceleration.y, acceleration.z);
}

/// Net force on a grain, or net torque over its circumradius, in its own weight.
double left_on(const SphereBed&, const std::vector<Record<double>>& u, std::size_t grain) {
  return net_force(u[grain]);
}
double left_on(const PolyhedronBed& bed, const std::vector<Record<double>>& u, std::size_t grain) {
  const Vector spin = vector_of(u[2 * grain + 1]);  // in units of the roots of the moments
  const Vector torque = spin.cwiseProduct(bed.root_inertia[grain]);
  return std::max(net_force(u[2 * grain]),
                  torque.norm() * bed.motion[grain].w / bed.circumradius(grain));
}

}  // namespace

template <class Kind, class Real>
Imbalance static_imbalance(double tolerance, double of_interest, const ExecutionContext& context,
                           const Bed<Kind>& bed, double dt, const Contacts<Kind, Real>& contacts,
                           StepState<Kind, double>& closed) {
  Bed<Kind> wrapped = bed;
  closed.candidates.is_listed = false;
  renew_candidates(tolerance, 0.0, context, wrapped, closed.candidates);
  lay_out_closed(tolerance, context, wrapped, closed.candidates, dt, contacts, closed.contacts);
  const double least = least_imbalance(bed, closed.contacts);
  if (least > of_interest) return {least, least};
  if constexpr (std::is_same_v<Kind, Sphere>) {
    if (is_tall(bed)) carry_weight(1.0, bed, closed.contacts);
  }
  set_free_fall(bed, closed.motion.free);
  SolveLimits limits;
  limits.iterations = most_sweeps;
  limits.tolerance = solved_to;
  solve(limits, context, closed.contacts, closed.motion);
  Imbalance imbalance;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double left = left_on(bed, closed.motion.u, i);
    imbalance.mean += left;
    imbalance.max = std::max(imbalance.max, left);
  }
  imbalance.mean /= static_cast<double>(std::max<std::size_t>(bed.grains(), 1));
  return imbalance;
}

template Imbalance static_imbalance(double, double, const ExecutionContext&, const SphereBed&,
                                    double, const SphereContacts<float>&,
                                    StepState<Sphere, double>&);
template Imbalance static_imbalance(double, double, const ExecutionContext&, const SphereBed&,
                                    double, const SphereContacts<double>&,
                                    StepState<Sphere, double>&);
template Imbalance static_imbalance(double, double, const ExecutionContext&, const PolyhedronBed&,
                                    double, const PolyhedronContacts<float>&,
                                    StepState<Polyhedron, double>&);
template Imbalance static_imbalance(double, double, const ExecutionContext&, const PolyhedronBed&,
                                    double, const PolyhedronContacts<double>&,
                                    StepState<Polyhedron, double>&);

}  // namespace grainsweep
