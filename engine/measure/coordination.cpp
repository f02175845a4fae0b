#include "engine/measure/coordination.hpp"

#include <limits>

namespace grainsweep {

namespace {

std::int64_t grains_in(const Grains& bed, const Slab& slab) {
  std::int64_t count = 0;
  for (const Record<double>& centre : bed.centres()) count += slab.contains(centre.z) ? 1 : 0;
  return count;
}
}  // namespace

Coordination coordination(const Grains& bed, const Touching& touching, const Slab& slab,
                          double gap_tolerance) {
  const std::int64_t grains = grains_in(bed, slab);
  if (grains == 0) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {gap_tolerance, unknown, unknown};
  }
  std::int64_t ends = 0, wall_ends = 0;
  const auto in_slab = [&](std::size_t i) { return slab.contains(bed.position[i].z) ? 1 : 0; };
  visit_touching(
      touching, gap_tolerance, [&](std::size_t grain, std::size_t) { ends += in_slab(grain); },
      [&](std::size_t grain) { wall_ends += in_slab(grain); });
  const double per_grain = 1.0 / static_cast<double>(grains);
  return {gap_tolerance, static_cast<double>(ends) * per_grain,
          static_cast<double>(ends + wall_ends) * per_grain};
}

std::vector<std::int32_t> neighbour_counts(std::size_t grains, const Touching& touching,
                                           double gap_tolerance) {
  std::vector<std::int32_t> counts(grains, 0);
  visit_touching(
      touching, gap_tolerance, [&](std::size_t grain, std::size_t) { ++counts[grain]; },
      [](std::size_t) {});
  return counts;
}

}  // namespace grainsweep
