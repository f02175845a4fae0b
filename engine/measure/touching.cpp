#include "engine/measure/touching.hpp"

#include "engine/broad/candidates.hpp"
#include "engine/measure/cut_polyhedron.hpp"
#include "engine/narrow/gjk.hpp"
#include "engine/narrow/separating_axes.hpp"
#include "engine/narrow/shape_contacts.hpp"
#include "engine/rows/contacts.hpp"

namespace grainsweep {

namespace {

void add_pairs(const SphereBed& bed, const Contacts<double>& contacts, double gap_tolerance,
               Touching& touching) {
  for (std::size_t block = 0; block < contacts.pair_blocks; ++block) {
    const RowBlock<double>& r = contacts.rows[block];
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (!bed.is_void(r.a(lane)) && r.gap[lane] < gap_tolerance) {
        touching.pairs.push_back({r.a(lane), r.b(lane), r.gap[lane]});
      }
    }
  }
}

void add_walls(const SphereBed& bed, const Candidates& candidates, double gap_tolerance,
               Touching& touching) {
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k].grains) {
      const double gap = bed.walls[k].gap(bed.position[static_cast<std::size_t>(grain)]);
      if (gap < gap_tolerance) {
        touching.walls.push_back({grain, static_cast<std::int32_t>(k), gap});
      }
    }
  }
}

double gap_of(const ShapeBed& bed, std::size_t a, std::size_t b) {
  const ShapePair pair{bed.shape, bed.shape, pair_pose(bed, a, b)};
  Simplex simplex;
  const Closest closest = closest_points(pair, simplex);
  return closest.distance > 0.0 ? closest.distance : separating_axes(pair).separation();
}

/// Gap of the lowest point of a grain to a wall, d.
double gap_of(const ShapeBed& bed, const Wall& wall, std::int32_t grain) {
  const Pose pose = bed.pose(static_cast<std::size_t>(grain));
  const Vector& c = pose.centre;
  const UnitVector n = wall.normal(c.x(), c.y(), c.z());
  const Vector outward = pose.orientation.conjugate() * -Vector(n.x, n.y, n.z);
  return wall.distance(c.x(), c.y(), c.z()) - pose.scale * reach_along(bed.shape, outward);
}

}  // namespace

Touching find_touching(SphereBed& bed, double gap_tolerance, const Kernels& kernels) {
  Candidates candidates;
  Contacts<double> contacts;
  Touching touching;
  find_candidates(bed, gap_tolerance, kernels, candidates);
  lay_out(bed, candidates, contacts);
  detect(bed, kernels, 1.0, contacts);
  add_pairs(bed, contacts, gap_tolerance, touching);
  add_walls(bed, candidates, gap_tolerance, touching);
  return touching;
}

Touching find_touching(ShapeBed& bed, double gap_tolerance, const Kernels& kernels) {
  wrap(bed);
  SphereBed balls;
  set_balls(bed, bed.shape.circumradius, balls);
  Candidates candidates;
  find_candidates(balls, gap_tolerance, kernels, candidates);
  Touching touching;
  for (const GrainPair pair : candidates.pairs) {
    const double gap =
        gap_of(bed, static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b));
    if (gap < gap_tolerance) touching.pairs.push_back({pair.a, pair.b, gap});
  }
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    for (const std::int32_t grain : candidates.walls[k].grains) {
      const double gap = gap_of(bed, bed.walls[k], grain);
      if (gap < gap_tolerance) {
        touching.walls.push_back({grain, static_cast<std::int32_t>(k), gap});
      }
    }
  }
  return touching;
}

}  // namespace grainsweep
