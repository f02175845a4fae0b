#include "engine/measure/order.hpp"

#include "engine/measure/bond_order.hpp"
#include "engine/measure/contact_forces.hpp"
#include "engine/measure/pair_correlation.hpp"

namespace grainsweep {

namespace {

// How finely and how far curves are made: distances in d, forces in means of their layer.
constexpr double distance_bin = 0.05, largest_distance = 4.0;
constexpr double force_bin = 0.1, largest_force = 8.0;

}  // namespace

double share_with_contacts(const Grains& bed, const Touching& touching, const Slab& slab,
                           double gap_tolerance, int contacts) {
  std::vector<int> counts(bed.grains(), 0);  // of touching grains and walls
  visit_touching(
      touching, gap_tolerance, [&](std::size_t grain, std::size_t) { ++counts[grain]; },
      [&](std::size_t grain) { ++counts[grain]; });
  double grains = 0.0, matching = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!slab.contains(bed.position[i].z)) continue;
    grains += 1.0;
    matching += counts[i] == contacts ? 1.0 : 0.0;
  }
  return matching / grains;  // 0 / 0 is NaN
}

double segregation(const Grains& bed, const Slab& slab, double small_below) {
  double small = 0.0, large = 0.0, small_height = 0.0, large_height = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    if (!slab.contains(p.z)) continue;
    const bool is_small = p.w < small_below;
    (is_small ? small : large) += 1.0;
    (is_small ? small_height : large_height) += p.z;
  }
  return (small_height / small - large_height / large) / slab.height();  // 0 / 0 is NaN
}

Order measure_order(const Grains& bed, const Touching& near,
                    const std::vector<PairForce>& pair_forces, const Slab& slab,
                    const ProfileSettings& settings, Curves& curves) {
  const BondOrder bonds = bond_order(bed, near, slab);
  ForceStatistics forces = force_statistics(pair_forces, slab, force_bin, largest_force);
  Order order;
  order.q6_global = bonds.global;
  order.q6_local = bonds.local;
  order.three_contact_share = share_with_contacts(bed, near, slab, settings.gap_tolerance, 3);
  order.segregation = segregation(bed, slab, settings.small_below);
  order.force_mean = forces.mean;
  order.force_square = forces.square;
  curves.pair_correlation = pair_correlation(bed, slab, distance_bin, largest_distance);
  curves.force_density = std::move(forces.density);
  return order;
}

}  // namespace grainsweep
