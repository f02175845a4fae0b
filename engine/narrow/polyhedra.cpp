#include "engine/narrow/polyhedra.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {

namespace {

struct Ends {
  std::size_t a, b;
};
Ends ends_of(GrainPair pair) {
  return {static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b)};
}

/// By how much two centres at this squared distance are too near, d; negative if they are not.
double sunk_by(const PolyhedronBed& bed, Ends at, double squared) {
  const double a = bed.shape(at.a).inradius, b = bed.shape(at.b).inradius;
  // a scale_a + b scale_b, in the bits of a (scale_a + scale_b) where both are alike.
  const double inner = (a + b) / 2.0 * (bed.scale(at.a) + bed.scale(at.b)) +
                       (a - b) / 2.0 * (bed.scale(at.a) - bed.scale(at.b));
  const double nearest = sunk_share * inner;
  return squared < nearest * nearest ? nearest - std::sqrt(squared) : 0.0;
}

void append(GrainPair pair, const PairPose& pose, const PairContact& contact, ContactList& found) {
  if (contact.count > 0) {
    found.contacts.push_back(
        {pair.a, pair.b, contact.kind, contact.normal, contact.first, contact.count, pose});
  }
}

/// Any convex shape: pair by pair.
double touch_each(const TouchSettings& settings, const PolyhedronBed& bed,
                  std::span<const GrainPair> pairs, std::span<PairMemory> memory,
                  TouchColumns& columns, ContactList& found) {
  double sunk = 0.0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Ends at = ends_of(pairs[k]);
    const ShapePair shapes = shape_pair(bed, at.a, at.b);
    sunk = std::max(sunk, sunk_by(bed, at, shapes.pose.centre.squaredNorm()));
    append(pairs[k], shapes.pose, touch(shapes, settings, memory[k], columns, found.points), found);
  }
  return sunk;
}

/// Lists the pairs whose balls are no further apart than the margin; returns what touch_pairs does.
double list_close(double margin, const PolyhedronBed& bed, std::span<const GrainPair> pairs,
                  std::vector<GrainPair>& close) {
  double sunk = 0.0;
  close.clear();
  for (const GrainPair pair : pairs) {
    const Ends at = ends_of(pair);
    const double reach = bed.circumradius(at.a) + bed.circumradius(at.b) + margin;
    const double squared = nearest_difference(bed, at.a, at.b).squaredNorm();
    if (squared > reach * reach) continue;
    close.push_back(pair);
    sunk = std::max(sunk, sunk_by(bed, at, squared));
  }
  return sunk;
}

void batch_axes(const Kernels& kernels, const PolyhedronBed& bed, NarrowColumns& columns) {
  const PinacoidHalves& w = *bed.shapes.front().pinacoid;
  columns.axes.assign((columns.close.size() + block_width - 1) / block_width, {});
  for (std::size_t k = 0; k < columns.axes.size() * block_width; ++k) {
    const GrainPair pair = k < columns.close.size() ? columns.close[k] : GrainPair{0, 0};
    columns.axes[k / block_width].set_grains(k % block_width, pair.a, pair.b);
  }
  // The records hold radii, half the scales.
  kernels.pinacoid_axes({2.0 * w.a, 2.0 * w.b, 2.0 * w.c, 2.0 * w.e}, columns.axes.data(),
                        columns.axes.size(), bed.position.data(), bed.orientation.data(),
                        bed.box.period_x(), bed.box.period_y());
}

/// Pinacoids: all axes of 16 pairs at a time.
double touch_pinacoids(const TouchSettings& settings, const Kernels& kernels,
                       const PolyhedronBed& bed, std::span<const GrainPair> pairs,
                       NarrowColumns& columns, ContactList& found) {
  const double sunk = list_close(settings.margin, bed, pairs, columns.close);
  batch_axes(kernels, bed, columns);
  for (std::size_t k = 0; k < columns.close.size(); ++k) {
    const PinacoidBlock& block = columns.axes[k / block_width];
    const std::size_t lane = k % block_width;
    const Ends at = ends_of(columns.close[k]);
    const double scale = std::max(bed.scale(at.a), bed.scale(at.b));
    if (parted_by(block, lane, settings.margin, scale)) continue;
    const ShapePair pair = shape_pair(bed, at.a, at.b);
    const ContactAxes axes = separating_axes(pair, block, lane);
    append(columns.close[k], pair.pose,
           touch(pair, settings, axes, columns.touch.clip, found.points), found);
  }
  return sunk;
}

/// Whether all grains are of one pinacoid, whatever component they are called.
bool are_one_pinacoid(const std::vector<ConvexShape>& shapes) {
  const auto& first = shapes.front().pinacoid;
  return first && std::all_of(shapes.begin() + 1, shapes.end(), [&](const ConvexShape& shape) {
           const auto& w = shape.pinacoid;
           return w && w->a == first->a && w->b == first->b && w->c == first->c && w->e == first->e;
         });
}

/// A wall's normal at the point nearest to a place of the box.
Vector normal_of(const Wall& wall, const Vector& place) {
  const UnitVector n = wall.normal(place.x(), place.y(), place.z());
  return {n.x, n.y, n.z};
}

/// Every vertex near a round wall touches it alone: its normal is that of its own place.
void touch_round_wall(std::size_t k, std::int32_t grain, double margin, const PolyhedronBed& bed,
                      ContactList& found) {
  const Wall& wall = bed.walls[k];
  const Pose pose = bed.pose(static_cast<std::size_t>(grain));
  const std::vector<Vector>& vertices = bed.shape(static_cast<std::size_t>(grain)).vertices;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector position = pose.scale * vertices[v];
    const Vector place = pose.centre + pose.orientation * position;
    const double gap = wall.distance(place.x(), place.y(), place.z());
    if (gap > margin) continue;
    const Vector normal = pose.orientation.conjugate() * -normal_of(wall, place);
    found.contacts.push_back({grain,
                              bed.wall_name(k) + static_cast<std::int32_t>(v),
                              AxisKind::none,
                              normal,
                              found.points.size(),
                              1,
                              {}});
    found.points.push_back({position, gap});
  }
}

}  // namespace

double touch_pairs(const TouchSettings& settings, const Kernels& kernels, const PolyhedronBed& bed,
                   std::span<const GrainPair> pairs, std::span<PairMemory> memory,
                   NarrowColumns& columns, ContactList& found) {
  return are_one_pinacoid(bed.shapes)
             ? touch_pinacoids(settings, kernels, bed, pairs, columns, found)
             : touch_each(settings, bed, pairs, memory, columns.touch, found);
}

void touch_wall(std::size_t k, const std::vector<std::int32_t>& grains, double margin,
                const PolyhedronBed& bed, ContactList& found) {
  const Wall& wall = bed.walls[k];
  for (const std::int32_t grain : grains) {
    if (wall.is_round()) {
      touch_round_wall(k, grain, margin, bed, found);
      continue;
    }
    const Pose pose = bed.pose(static_cast<std::size_t>(grain));
    const std::size_t first = found.points.size();
    const std::size_t count =
        touch_wall(bed.shape(static_cast<std::size_t>(grain)), pose, wall, margin, found.points);
    if (count > 0) {
      const Vector normal = pose.orientation.conjugate() * -normal_of(wall, pose.centre);
      found.contacts.push_back({grain, bed.wall_name(k), AxisKind::none, normal, first, count, {}});
    }
  }
}

}  // namespace grainsweep
