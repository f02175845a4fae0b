#include "engine/narrow/clearance.hpp"

#include <cmath>

namespace grainsweep {

namespace {

void begin(const PolyhedronBed& bed, GrainPaths& paths) {
  paths.path.assign(bed.grains(), 0.0);
  paths.largest = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    paths.largest = std::max(paths.largest, bed.circumradius(i));
  }
  paths.period = std::numeric_limits<double>::infinity();
  for (const double period : {bed.box.period_x(), bed.box.period_y()}) {
    if (period > 0.0) paths.period = std::min(paths.period, period);
  }
  paths.centre = bed.position;
  paths.orientation = bed.orientation;
}

/// Between two places, d, along axes with images the nearest.
double distance(const Box& box, const Record<double>& p, const Record<double>& q) {
  const double x = nearest_image(q.x - p.x, box.period_x());
  const double y = nearest_image(q.y - p.y, box.period_y());
  const double z = q.z - p.z;
  return std::sqrt(x * x + y * y + z * z);
}

/// How far a turn from one unit quaternion to another moves a point at a distance of 1: no more than
/// twice the distance between them, of which q and -q are the same turn.
double turned(const Record<double>& p, const Record<double>& q) {
  const double sign = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0.0 ? -1.0 : 1.0;
  const double x = p.x - sign * q.x, y = p.y - sign * q.y;
  const double z = p.z - sign * q.z, w = p.w - sign * q.w;
  return 2.0 * std::sqrt(x * x + y * y + z * z + w * w);
}

}  // namespace

void follow(const PolyhedronBed& bed, const ParallelFor& loop, GrainPaths& paths) {
  if (paths.path.size() != bed.grains()) {
    begin(bed, paths);
    return;
  }
  // From the centre of one grain to the farthest point of another that is near.
  const double lever = 3.0 * paths.largest + GrainPaths::widest;
  parallel_chunks(loop, bed.grains(), bed.subdomains, [&](std::size_t, IndexRange grains) {
    for (std::size_t i = grains.first; i < grains.last; ++i) {
      paths.path[i] += distance(bed.box, paths.centre[i], bed.position[i]) +
                       lever * turned(paths.orientation[i], bed.orientation[i]);
      paths.centre[i] = bed.position[i];
      paths.orientation[i] = bed.orientation[i];
    }
  });
}

}  // namespace grainsweep
