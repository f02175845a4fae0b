#include "engine/measure/touching.hpp"

#include <algorithm>
#include <cmath>

#include "engine/narrow/ball_pair.hpp"
#include "engine/narrow/gjk.hpp"
#include "engine/narrow/polyhedra.hpp"
#include "engine/narrow/separating_axes.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

// ---- gaps of the kinds of grains, d ----

double pair_gap(const SphereBed& bed, std::size_t a, std::size_t b, const Kernels&) {
  const Vector between = nearest_difference(bed, a, b);
  return std::sqrt(between.squaredNorm()) - (bed.position[a].w + bed.position[b].w);
}
double pair_gap(const PolyhedronBed& bed, std::size_t a, std::size_t b, const Kernels& kernels) {
  const ShapePair pair = shape_pair(bed, a, b);
  if (has_ball(pair)) return ball_contact(pair).gap;
  const Closest closest = closest_points(pair, kernels.hull);
  return closest.distance > 0.0 ? closest.distance
                                : separating_axes(pair, kernels.hull).separation();
}

double wall_gap(const SphereBed& bed, const Wall& wall, std::size_t grain) {
  return wall.gap(bed.position[grain]);
}
/// Gap of the vertex that is nearest to the wall (no wall is convex), or of a sphere.
double wall_gap(const PolyhedronBed& bed, const Wall& wall, std::size_t grain) {
  if (bed.shape(grain).is_ball) return wall.gap(bed.position[grain]);
  const Pose pose = bed.pose(grain);
  double gap = infinity;
  for (const Vector& vertex : bed.shape(grain).vertices) {
    const Vector place = pose.place(vertex);
    gap = std::min(gap, wall.distance(place.x(), place.y(), place.z()));
  }
  return gap;
}

}  // namespace

template <class Kind>
Touching find_touching(Bed<Kind>& bed, const PairReach& tolerance_of, const Kernels& kernels) {
  wrap(bed);
  std::vector<Record<double>> column;
  Candidates candidates;
  find_candidates(balls_of(bed, column), tolerance_of, kernels, candidates);
  Touching touching;
  for (const GrainPair pair : candidates.pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const double gap = pair_gap(bed, a, b, kernels);
    if (gap < tolerance_of(bed.position[a].w, bed.position[b].w)) {
      touching.pairs.push_back({pair.a, pair.b, gap});
    }
  }
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k]) {
      const double gap = wall_gap(bed, bed.walls[k], static_cast<std::size_t>(grain));
      if (gap < candidates.reach) {
        touching.walls.push_back({grain, static_cast<std::int32_t>(k), gap});
      }
    }
  }
  return touching;
}

template Touching find_touching(SphereBed&, const PairReach&, const Kernels&);
template Touching find_touching(PolyhedronBed&, const PairReach&, const Kernels&);
}  // namespace grainsweep
