#include "engine/narrow/shape_contacts.hpp"

#include <algorithm>

namespace grainsweep {

namespace {

bool renew_candidates(const ShapeSearchSettings& settings, const ExecutionContext& context,
                      PolyhedronBed& bed, ShapeSearch& search) {
  const double near = settings.touch.margin;
  if (search.has_candidates &&
      still_complete(balls_of(bed, search.balls), near, search.candidates)) {
    return false;
  }
  wrap(bed);
  find_candidates(balls_of(bed, search.balls), near + settings.reach, context, search.candidates);
  search.memory.assign(search.candidates.pairs.size(), {});
  search.has_candidates = true;
  return true;
}

struct Ends {
  std::size_t a, b;
};
Ends ends_of(GrainPair pair) {
  return {static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b)};
}

void append(GrainPair pair, const PairPose& pose, const PairContact& contact,
            ShapeContacts& found) {
  if (contact.count > 0) {
    found.contacts.push_back(
        {pair.a, pair.b, contact.kind, contact.normal, contact.first, contact.count, pose});
  }
}

/// Any convex shape: pair by pair.
void touch_pairs(const TouchSettings& settings, const PolyhedronBed& bed, ShapeSearch& search,
                 ShapeContacts& found) {
  for (std::size_t k = 0; k < search.candidates.pairs.size(); ++k) {
    const GrainPair pair = search.candidates.pairs[k];
    const Ends at = ends_of(pair);
    const ShapePair shapes{bed.shape, bed.shape, pair_pose(bed, at.a, at.b)};
    append(pair, shapes.pose, touch(shapes, settings, search.memory[k], search.clip, found.points),
           found);
  }
}

/// Candidate pairs whose balls are no further apart than the margin.
void list_close(double margin, const PolyhedronBed& bed, ShapeSearch& search) {
  search.close.clear();
  for (const GrainPair pair : search.candidates.pairs) {
    const Ends at = ends_of(pair);
    const double reach = bed.circumradius(at.a) + bed.circumradius(at.b) + margin;
    if (nearest_difference(bed, at.a, at.b).squaredNorm() <= reach * reach) {
      search.close.push_back(pair);
    }
  }
}

void batch_axes(const ExecutionContext& context, const PolyhedronBed& bed, ShapeSearch& search) {
  const PinacoidHalves& w = *bed.shape.pinacoid;
  search.axes.assign((search.close.size() + block_width - 1) / block_width, {});
  for (std::size_t k = 0; k < search.axes.size() * block_width; ++k) {
    const GrainPair pair = k < search.close.size() ? search.close[k] : GrainPair{0, 0};
    search.axes[k / block_width].set_grains(k % block_width, pair.a, pair.b);
  }
  // The records hold radii, half the scales.
  context.kernels.pinacoid_axes({2.0 * w.a, 2.0 * w.b, 2.0 * w.c, 2.0 * w.e}, search.axes.data(),
                                search.axes.size(), bed.position.data(), bed.orientation.data(),
                                bed.box.period_x(), bed.box.period_y());
}

/// Pinacoids: all axes of 16 pairs at a time.
void touch_pinacoids(const TouchSettings& settings, const ExecutionContext& context,
                     const PolyhedronBed& bed, ShapeSearch& search, ShapeContacts& found) {
  list_close(settings.margin, bed, search);
  batch_axes(context, bed, search);
  for (std::size_t k = 0; k < search.close.size(); ++k) {
    const PinacoidBlock& block = search.axes[k / block_width];
    const std::size_t lane = k % block_width;
    const Ends at = ends_of(search.close[k]);
    const double scale = std::max(bed.scale(at.a), bed.scale(at.b));
    if (parted_by(block, lane, settings.margin, scale)) continue;
    const ShapePair pair{bed.shape, bed.shape, pair_pose(bed, at.a, at.b)};
    const ContactAxes axes = separating_axes(pair, block, lane);
    append(search.close[k], pair.pose, touch(pair, settings, axes, search.clip, found.points),
           found);
  }
}

/// A wall's normal at the point nearest to a place of the box.
Vector normal_of(const Wall& wall, const Vector& place) {
  const UnitVector n = wall.normal(place.x(), place.y(), place.z());
  return {n.x, n.y, n.z};
}

void touch_walls(double margin, const PolyhedronBed& bed, const Candidates& candidates,
                 ShapeContacts& found) {
  for (std::size_t k = 0; k < candidates.walls.size(); ++k) {
    const Wall& wall = bed.walls[k];
    for (const std::int32_t grain : candidates.walls[k].grains) {
      const Pose pose = bed.pose(static_cast<std::size_t>(grain));
      const std::size_t first = found.points.size();
      const std::size_t count = touch_wall(bed.shape, pose, wall, margin, found.points);
      if (count > 0) {
        const Vector normal = pose.orientation.conjugate() * -normal_of(wall, pose.centre);
        found.contacts.push_back(
            {grain, bed.wall_name(k), AxisKind::none, normal, first, count, {}});
      }
    }
  }
}

}  // namespace

bool find_contacts(const ShapeSearchSettings& settings, const ExecutionContext& context,
                   PolyhedronBed& bed, ShapeSearch& search, ShapeContacts& found) {
  const bool renewed = renew_candidates(settings, context, bed, search);
  found.contacts.clear();
  found.points.clear();
  if (bed.shape.pinacoid) {
    touch_pinacoids(settings.touch, context, bed, search, found);
  } else {
    touch_pairs(settings.touch, bed, search, found);
  }
  touch_walls(settings.touch.margin, bed, search.candidates, found);
  return renewed;
}

}  // namespace grainsweep
