#include "engine/dynamics/rest.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/text.hpp"

namespace grainsweep {

namespace {

/// Grains joined by contacts (union by halving paths).
class Clusters {
 public:
  explicit Clusters(std::size_t grains) : parent_(grains) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    parent_[root(static_cast<std::size_t>(a))] = root(static_cast<std::size_t>(b));
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Grains that push each other are of one cluster.
template <class Real>
Clusters clusters_of(const SphereBed& bed, const Contacts<Real>& contacts, double dt) {
  Clusters clusters(bed.grains());
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane) {
    if (block < contacts.pair_blocks) {
      clusters.join(contacts.rows[block].a(lane), contacts.rows[block].b(lane));
    }
  });
  return clusters;
}

/// Bit `axis` of entry i: a wall of that axis pushes a grain of the cluster rooted at i.
template <class Real>
std::vector<unsigned> pushed_axes(const SphereBed& bed, const Contacts<Real>& contacts, double dt,
                                  Clusters& clusters) {
  std::vector<unsigned> axes(bed.grains(), 0U);
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane) {
    if (block >= contacts.pair_blocks) {
      const RowBlock<Real>& r = contacts.rows[block];
      const unsigned axis = r.normal_z[lane] != Real(0)   ? 2U
                            : r.normal_y[lane] != Real(0) ? 1U
                                                          : 0U;
      axes[clusters.root(static_cast<std::size_t>(r.a(lane)))] |= 1U << axis;
    }
  });
  return axes;
}

std::string exceeds(const char* what, double value, double tolerance, const char* unit) {
  return std::string(what) + " " + number_text(value) + " " + unit + " exceeds " +
         number_text(tolerance);
}

}  // namespace

template <class Real>
RestReport certify(const SphereBed& bed, const ExecutionContext& context, double dt,
                   Contacts<Real>& contacts) {
  RestReport rest;
  double overlap = 0.0, bearing = 0.0;
  detect(bed, context, 1.0, contacts);
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane) {
    const auto gap = static_cast<double>(contacts.rows[block].gap[lane]);
    const double depth = std::max(0.0, -gap);
    overlap += depth;
    bearing += 1.0;
    rest.overlap_max = std::max(rest.overlap_max, depth);
    rest.contacts += gap < closed_gap ? 1 : 0;
  });
  rest.overlap_mean = overlap / std::max(bearing, 1.0);
  rest.isostatic_contacts =
      3 * static_cast<std::int64_t>(bed.grains()) - zero_modes(bed, contacts, dt);
  return rest;
}

template <class Real>
std::int64_t zero_modes(const SphereBed& bed, const Contacts<Real>& contacts, double dt) {
  Clusters clusters = clusters_of(bed, contacts, dt);
  std::int64_t modes = 0;
  for (const unsigned axes : pushed_axes(bed, contacts, dt, clusters)) {
    const bool stands = (axes & 4U) != 0U;
    modes += stands ? 2 - static_cast<int>(axes & 1U) - static_cast<int>((axes >> 1U) & 1U) : 0;
  }
  return modes;
}

template <class Real>
double carried_weight(const SphereBed& bed, const Contacts<Real>& contacts, double dt) {
  double weight = 0.0, carried = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    weight += 1.0 / bed.motion[i].w;
  }
  const WallRows& floor = contacts.walls.front();
  for (std::size_t k = floor.first * block_width; k < (floor.first + floor.blocks) * block_width;
       ++k) {
    carried += static_cast<double>(contacts.impulse[k]);
  }
  return weight > 0.0 ? carried / (dt * dt * weight) : 1.0;
}

template <class Real>
std::vector<PairForce> pair_forces(const SphereBed& bed, const Contacts<Real>& contacts,
                                   double dt) {
  std::vector<PairForce> forces;
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane) {
    if (block >= contacts.pair_blocks) {
      return;
    }
    const std::int32_t a = contacts.rows[block].a(lane), b = contacts.rows[block].b(lane);
    const double height = (bed.position[static_cast<std::size_t>(a)].z +
                           bed.position[static_cast<std::size_t>(b)].z) /
                          2.0;
    const auto impulse = static_cast<double>(contacts.impulse[block * block_width + lane]);
    forces.push_back({a, b, height, impulse / (dt * dt)});
  });
  return forces;
}

template <class Real>
std::vector<double> force_sums(const SphereBed& bed, const Contacts<Real>& contacts, double dt) {
  std::vector<double> force(bed.position.size(), 0.0);
  visit_force_bearing(contacts, dt, [&](std::size_t block, std::size_t lane) {
    const double magnitude =
        static_cast<double>(contacts.impulse[block * block_width + lane]) / (dt * dt);
    force[static_cast<std::size_t>(contacts.rows[block].a(lane))] += magnitude;
    force[static_cast<std::size_t>(contacts.rows[block].b(lane))] += magnitude;
  });
  force.resize(bed.grains());
  return force;
}

std::string why_not_at_rest(const RestReport& rest, const Accuracy& accuracy) {
  const auto isostatic = static_cast<double>(rest.isostatic_contacts);
  const double excess = static_cast<double>(rest.contacts) - isostatic;
  if (!(rest.residual <= accuracy.residual_tolerance)) {
    return exceeds("force residual", rest.residual, accuracy.residual_tolerance, "m g");
  }
  if (!(rest.kinetic_energy <= accuracy.kinetic_tolerance)) {
    return exceeds("kinetic energy", rest.kinetic_energy, accuracy.kinetic_tolerance,
                   "m g d per grain");
  }
  if (!(rest.overlap_mean <= accuracy.overlap_tolerance)) {
    return exceeds("mean overlap", rest.overlap_mean, accuracy.overlap_tolerance, "d");
  }
  if (!(rest.overlap_max <= deepest_overlap * accuracy.overlap_tolerance)) {
    return exceeds("deepest overlap", rest.overlap_max,
                   deepest_overlap * accuracy.overlap_tolerance, "d");
  }
  if (!(std::abs(excess) <= accuracy.contact_tolerance * isostatic)) {
    return "contacts / isostatic count " + number_text(1.0 + excess / std::max(isostatic, 1.0)) +
           " misses 1 by more than " + number_text(accuracy.contact_tolerance);
  }
  return {};
}

template RestReport certify(const SphereBed&, const ExecutionContext&, double, Contacts<float>&);
template RestReport certify(const SphereBed&, const ExecutionContext&, double, Contacts<double>&);
template std::int64_t zero_modes(const SphereBed&, const Contacts<float>&, double);
template std::int64_t zero_modes(const SphereBed&, const Contacts<double>&, double);
template double carried_weight(const SphereBed&, const Contacts<float>&, double);
template double carried_weight(const SphereBed&, const Contacts<double>&, double);
template std::vector<PairForce> pair_forces(const SphereBed&, const Contacts<float>&, double);
template std::vector<PairForce> pair_forces(const SphereBed&, const Contacts<double>&, double);
template std::vector<double> force_sums(const SphereBed&, const Contacts<float>&, double);
template std::vector<double> force_sums(const SphereBed&, const Contacts<double>&, double);

}  // namespace grainsweep
