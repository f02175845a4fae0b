#include "engine/measure/touching.hpp"

#include "engine/contact/candidates.hpp"
#include "engine/contact/closest.hpp"
#include "engine/contact/contacts.hpp"
#include "engine/contact/separating_axes.hpp"
#include "engine/contact/shape_contacts.hpp"
#include "engine/measure/cut_polyhedron.hpp"

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
      const double gap =
          candidates.walls[k].wall.gap(bed.position[static_cast<std::size_t>(grain)]);
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
  const Span span = span_along(bed.shape, bed.pose(static_cast<std::size_t>(grain)), wall.axis);
  return wall.offset + (wall.sign > 0.0 ? span.low : -span.high);
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
      const double gap = gap_of(bed, candidates.walls[k].wall, grain);
      if (gap < gap_tolerance) {
        touching.walls.push_back({grain, static_cast<std::int32_t>(k), gap});
      }
    }
  }
  return touching;
}

}  // namespace grainsweep
