#include "engine/rows/travel.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

double square(double x) { return x * x; }

/// How far the centre of a grain has come, d.
double moved(const Box& box, const Record<double>& from, const Record<double>& to) {
  return std::sqrt(square(nearest_image(to.x - from.x, box.period_x())) +
                   square(nearest_image(to.y - from.y, box.period_y())) + square(to.z - from.z));
}

/// No less than how far a point at a distance of 1 from the axis of a turn has come: twice the sine
/// of half its angle, where two quaternions are twice the sine of a quarter of it apart.
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
        travel.way[i] += moved(bed.box, travel.position[i], bed.position[i]) +
                         bed.circumradius(i) * turned(travel.orientation[i], bed.orientation[i]);
      }
      travel.position[i] = bed.position[i];
      travel.orientation[i] = bed.orientation[i];
    }
  });
}

}  // namespace grainsweep
