#include "engine/rows/travel.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

double square(double x) { return x * x; }

/// Upper bound of how far a turn moves a point at a distance of 1 from its axis: twice the sine of
/// half its angle, where the two quaternions are twice the sine of a quarter of the angle apart.
double turned(const Record<double>& from, const Record<double>& to) {
  const double same =
      square(to.x - from.x) + square(to.y - from.y) + square(to.z - from.z) + square(to.w - from.w);
  const double opposite =
      square(to.x + from.x) + square(to.y + from.y) + square(to.z + from.z) + square(to.w + from.w);
  return 2.0 * std::sqrt(std::min(same, opposite));
}

}  // namespace

void add_travel(const PolyhedronBed& bed, const ParallelFor& loop, Travel& travel) {
  const std::size_t before = travel.way.size();
  travel.position.resize(bed.grains());
  travel.orientation.resize(bed.grains());
  travel.way.resize(bed.grains(), 0.0);
  parallel_items(loop, bed.grains(), [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      if (i < before) {
        travel.way[i] += nearest_difference(bed.box, travel.position[i], bed.position[i]).norm() +
                         bed.circumradius(i) * turned(travel.orientation[i], bed.orientation[i]);
      }
      travel.position[i] = bed.position[i];
      travel.orientation[i] = bed.orientation[i];
    }
  });
}

}  // namespace grainsweep
