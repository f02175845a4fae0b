#include "engine/measure/coordination.hpp"

#include <limits>

namespace grainsweep {

namespace {

bool lies_in(const Grains& bed, std::int32_t grain, const Slab& slab) {
  return slab.contains(bed.position[static_cast<std::size_t>(grain)].z);
}

std::int64_t grains_in(const Grains& bed, const Slab& slab) {
  std::int64_t count = 0;
  for (std::int32_t i = 0; i < bed.wall(); ++i) {
    count += lies_in(bed, i, slab) ? 1 : 0;
  }
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
  for (const TouchingPair& pair : touching.pairs) {
    if (pair.gap < gap_tolerance) {
      ends += (lies_in(bed, pair.a, slab) ? 1 : 0) + (lies_in(bed, pair.b, slab) ? 1 : 0);
    }
  }
  for (const TouchingWall& wall : touching.walls) {
    wall_ends += wall.gap < gap_tolerance && lies_in(bed, wall.grain, slab) ? 1 : 0;
  }
  const double per_grain = 1.0 / static_cast<double>(grains);
  return {gap_tolerance, static_cast<double>(ends) * per_grain,
          static_cast<double>(ends + wall_ends) * per_grain};
}

std::vector<std::int32_t> neighbour_counts(std::size_t grains, const Touching& touching,
                                           double gap_tolerance) {
  std::vector<std::int32_t> counts(grains, 0);
  for (const TouchingPair& pair : touching.pairs) {
    if (pair.gap < gap_tolerance) {
      ++counts[static_cast<std::size_t>(pair.a)];
      ++counts[static_cast<std::size_t>(pair.b)];
    }
  }
  return counts;
}

}  // namespace grainsweep
