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

// How much rounding may add to a separation or to how far grains have moved, d.
constexpr double rounding = 1e-9;

/// Whether a pair cannot have come within the margin since it was found apart.
bool is_far(const FarPairs& far, std::size_t k, GrainPair pair, double margin) {
  return far.until[k] - far.travel_of(pair) > margin + rounding;
}

/// Notes that a pair whose nearest images, at this distance, were parted by `separation` is apart:
/// by that, or by the least separation of its next images, a period away, if that is less.
void note_apart(const PolyhedronBed& bed, std::size_t k, GrainPair pair, double distance,
                double separation, const FarPairs& far) {
  const Ends at = ends_of(pair);
  const double of_next =
      shortest_period(bed.box) - distance - bed.circumradius(at.a) - bed.circumradius(at.b);
  far.until[k] = far.travel_of(pair) + std::min(separation, of_next);
}

void append(GrainPair pair, const PairPose& pose, const PairContact& contact, ContactList& found) {
  found.contacts.push_back({pair.a, pair.b, contact.kind, contact.normal, contact.first,
                            contact.count, pose, contact.edges, contact.parted});
}

/// The pinacoids of different proportions among the shapes of a bed.
struct PinacoidKinds {
  std::vector<PinacoidHalves> kinds;
  std::vector<std::size_t> of_shape;  ///< the kind of each shape; the number of kinds if it is not
                                      ///< a pinacoid
};

PinacoidKinds pinacoid_kinds(const std::vector<ConvexShape>& shapes) {
  PinacoidKinds all;
  const auto place_of = [&](const ConvexShape& shape) {
    return std::find(all.kinds.begin(), all.kinds.end(), shape.pinacoid);
  };
  for (const ConvexShape& shape : shapes) {
    if (shape.pinacoid && place_of(shape) == all.kinds.end()) all.kinds.push_back(*shape.pinacoid);
  }
  for (const ConvexShape& shape : shapes) {
    all.of_shape.push_back(static_cast<std::size_t>(place_of(shape) - all.kinds.begin()));
  }
  return all;
}

/// Lists the pairs whose balls are no further apart than the margin, but for rounding; returns what
/// touch_pairs returns.
double list_close(double margin, const PolyhedronBed& bed, std::span<const GrainPair> pairs,
                  const FarPairs& far, std::vector<ClosePair>& close) {
  double sunk = 0.0;
  close.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (is_far(far, k, pairs[k], margin)) continue;
    const Ends at = ends_of(pairs[k]);
    const double size = bed.circumradius(at.a) + bed.circumradius(at.b);
    const double reach = size + margin + rounding;
    const double squared = nearest_difference(bed, at.a, at.b).squaredNorm();
    if (squared > reach * reach) {
      const double distance = std::sqrt(squared);
      note_apart(bed, k, pairs[k], distance, distance - size, far);
      continue;
    }
    close.push_back({static_cast<std::uint32_t>(k), ClosePair::no_lane, squared});
    sunk = std::max(sunk, sunk_by(bed, at, squared));
  }
  return sunk;
}

/// The kinds of the grains of a pair, as one number below the number of all pairs of kinds; equal
/// to that number if one of them is not a pinacoid.
std::size_t kinds_of(const PolyhedronBed& bed, const PinacoidKinds& all, GrainPair pair) {
  const Ends at = ends_of(pair);
  const std::size_t kinds = all.kinds.size();
  const std::size_t a = all.of_shape[bed.component(at.a)], b = all.of_shape[bed.component(at.b)];
  return a < kinds && b < kinds ? a * kinds + b : kinds * kinds;
}

/// Gives close pairs of pinacoids lanes of blocks, those of two kinds in blocks of their own, and
/// returns where the blocks of each pair of kinds begin, and where they end.
std::vector<std::size_t> take_lanes(const PolyhedronBed& bed, const PinacoidKinds& all,
                                    std::span<const GrainPair> pairs, NarrowColumns& columns) {
  const std::size_t count = all.kinds.size() * all.kinds.size();
  std::vector<std::size_t> lanes(count + 1, 0), begin(1, 0), next;
  for (const ClosePair& close : columns.close) ++lanes[kinds_of(bed, all, pairs[close.number])];
  for (std::size_t k = 0; k < count; ++k) {
    next.push_back(begin.back() * block_width);
    begin.push_back(begin.back() + (lanes[k] + block_width - 1) / block_width);
  }
  columns.axes.assign(begin.back(), {});
  for (ClosePair& close : columns.close) {
    const GrainPair pair = pairs[close.number];
    const std::size_t k = kinds_of(bed, all, pair);
    if (k == count) continue;
    const std::size_t lane = next[k]++;
    columns.axes[lane / block_width].set_grains(lane % block_width, pair.a, pair.b);
    close.lane = static_cast<std::uint32_t>(lane);
  }
  return begin;
}

/// Tests the axes of all close pairs of pinacoids.
void batch_axes(const Kernels& kernels, const PolyhedronBed& bed, const PinacoidKinds& all,
                std::span<const GrainPair> pairs, NarrowColumns& columns) {
  const std::vector<std::size_t> begin = take_lanes(bed, all, pairs, columns);
  const auto doubled = [](const PinacoidHalves& w) {  // the records hold radii, half the scales
    return PinacoidHalves{2.0 * w.a, 2.0 * w.b, 2.0 * w.c, 2.0 * w.e};
  };
  for (std::size_t k = 0; k + 1 < begin.size(); ++k) {
    kernels.pinacoid_axes(doubled(all.kinds[k / all.kinds.size()]),
                          doubled(all.kinds[k % all.kinds.size()]), columns.axes.data() + begin[k],
                          begin[k + 1] - begin[k], bed.position.data(), bed.orientation.data(),
                          bed.box.period_x(), bed.box.period_y());
  }
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
    const Vector place = pose.place(vertices[v]);
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
    found.points.push_back({pose.scale * vertices[v], gap});
  }
}

}  // namespace

bool needs_memory(const PolyhedronBed& bed) {
  return std::any_of(bed.shapes.begin(), bed.shapes.end(),
                     [](const ConvexShape& shape) { return !shape.pinacoid; });
}

double touch_pairs(const TouchSettings& settings, const Kernels& kernels, const PolyhedronBed& bed,
                   std::span<const GrainPair> pairs, FarPairs far, std::span<PairMemory> memory,
                   NarrowColumns& columns, ContactList& found) {
  const double sunk = list_close(settings.margin, bed, pairs, far, columns.close);
  batch_axes(kernels, bed, pinacoid_kinds(bed.shapes), pairs, columns);
  columns.touch.use(kernels);
  for (const ClosePair& close : columns.close) {
    const GrainPair pair = pairs[close.number];
    const Ends at = ends_of(pair);
    const bool is_tested = close.lane != ClosePair::no_lane;
    const PinacoidBlock* block = is_tested ? &columns.axes[close.lane / block_width] : nullptr;
    const std::size_t lane = close.lane % block_width;
    const auto note = [&](double separation) {
      note_apart(bed, close.number, pair, std::sqrt(close.squared), separation, far);
    };
    if (is_tested) {
      const double reach = std::max(
          {bed.scale(at.a), bed.scale(at.b), bed.circumradius(at.a), bed.circumradius(at.b)});
      const double separation = parted_by(*block, lane, reach);
      if (separation > settings.margin) {
        note(separation);
        continue;
      }
    }
    const ShapePair shapes = shape_pair(bed, at.a, at.b);
    const PairContact contact =
        is_tested ? touch(shapes, settings, separating_axes(shapes, *block, lane),
                          columns.touch.clip, found.points)
                  : touch(shapes, settings, memory[close.number], columns.touch, found.points);
    if (contact.count == 0) {
      note(contact.separation);
    } else {
      append(pair, shapes.pose, contact, found);
    }
  }
  return sunk;
}

void touch_wall(std::size_t k, const std::vector<std::int32_t>& grains, double margin,
                const PolyhedronBed& bed, ContactList& found) {
  const Wall& wall = bed.walls[k];
  for (const std::int32_t grain : grains) {
    if (wall.is_round() && bed.turns(static_cast<std::size_t>(grain))) {
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
