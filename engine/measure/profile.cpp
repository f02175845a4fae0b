#include "engine/measure/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/measure/cut_sphere.hpp"
#include "engine/measure/cut_tube.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Bins along one axis: outside the box a bin's number wraps or stops at the border.
struct Bins {
  double width;
  std::int64_t count;
  bool wraps;

  std::size_t index(std::int64_t number) const {
    const std::int64_t inside =
        wraps ? (number % count + count) % count : std::clamp<std::int64_t>(number, 0, count - 1);
    return static_cast<std::size_t>(inside);
  }
  std::int64_t number_at(double coordinate) const {
    return static_cast<std::int64_t>(std::floor(coordinate / width));
  }
};

bool is_small(const Record<double>& sphere, const ProfileSettings& settings) {
  return sphere.w < settings.small_below;
}

/// Adds the volume of one grain to the bins it reaches; `below(t)` is its volume below the plane at
/// t, all of it for t infinite. Differences of one function: nothing is lost between bins.
template <class Below>
void add_volume(const Span& span, const Bins& bins, double ProfileBin::*member, Below below,
                Profile& profile) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::int64_t last = bins.number_at(span.high);
  double before = 0.0;
  for (std::int64_t k = bins.number_at(span.low); k <= last; ++k) {
    const double volume = below(k == last ? infinity : static_cast<double>(k + 1) * bins.width);
    profile.bins[bins.index(k)].*member += volume - before;
    before = volume;
  }
}

/// Turns volumes into solid fractions.
void divide_volume(double bin_volume, ProfileBin& bin) {
  bin.large /= bin_volume;
  bin.small /= bin_volume;
}
void divide_volumes(double bin_volume, Profile& profile) {
  for (ProfileBin& bin : profile.bins) divide_volume(bin_volume, bin);
}

/// Counts grains and what they touch; `bin_of(sphere)` is the bin, or null outside.
template <class BinOf>
void count_grains(const Grains& bed, const Touching& touching, const ProfileSettings& settings,
                  BinOf bin_of) {
  const auto at = [&](std::int32_t i) { return bin_of(bed.position[static_cast<std::size_t>(i)]); };
  for (std::int32_t i = 0; i < bed.wall(); ++i) {
    if (ProfileBin* bin = at(i)) {
      ++(is_small(bed.position[static_cast<std::size_t>(i)], settings) ? bin->small_grains
                                                                       : bin->large_grains);
    }
  }
  for (const TouchingPair& pair : touching.pairs) {
    for (const std::int32_t grain : {pair.a, pair.b}) {
      ProfileBin* bin = pair.gap < settings.gap_tolerance ? at(grain) : nullptr;
      if (bin != nullptr) ++bin->neighbours;
    }
  }
  for (const TouchingWall& wall : touching.walls) {
    ProfileBin* bin = wall.gap < settings.gap_tolerance ? at(wall.grain) : nullptr;
    if (bin != nullptr) ++bin->walls;
  }
}

double ProfileBin::*class_of(const Record<double>& sphere, const ProfileSettings& settings) {
  return is_small(sphere, settings) ? &ProfileBin::small : &ProfileBin::large;
}

/// Volume of a sphere below a plane across x or y, as far as it lies in the slab.
double volume_in_slab(const Record<double>& sphere, const Slab& slab, double top) {
  const double low = slab.bottom - sphere.z, high = slab.top - sphere.z;
  if (low <= -sphere.w && high >= sphere.w) {
    return sphere_slab_volume(sphere.w, -sphere.w, top);
  }
  return sphere_beam_volume(sphere.w, top, low, high);
}

// ---- volumes below a plane, by kind of grain ----

/// Volume of a grain below the plane at `top` across x or y, as far as it lies in the slab.
double volume_below(const SphereBed& bed, std::size_t i, int axis, double top, const Slab& slab) {
  const Record<double>& p = bed.position[i];
  return volume_in_slab(p, slab, top - (axis == 0 ? p.x : p.y));
}
double volume_below(const PolyhedronBed& bed, std::size_t i, int axis, double top,
                    const Slab& slab) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector high(infinity, infinity, slab.top);
  high[axis] = top;
  return box_volume(bed.shape(i), bed.pose(i), {-infinity, -infinity, slab.bottom}, high);
}

/// The part of a duct or a tube that is farther than `distance` from all upright walls, within the
/// slab.
struct Core {
  Span x, y, z;
  bool is_round = false;
  double axis = 0.0, radius = 0.0;  ///< of a round one: the axis stands at x = y = axis
};
Core core_of(const Box& box, const Slab& slab, double distance) {
  const auto inner = [&](double extent) {
    return Span{distance, std::max(distance, extent - distance)};
  };
  return {inner(box.length), inner(box.width), {slab.bottom, slab.top},
          box.is_tube,       box.length / 2.0, box.length / 2.0 - distance};
}

/// Distance of a centre from the axis of a tube, which stands at x = y = axis, d.
double distance_from(double axis, const Record<double>& p) {
  const double x = p.x - axis, y = p.y - axis;
  return std::sqrt(x * x + y * y);
}

/// Volume of a grain in that part.
double volume_in(const Core& core, const SphereBed& bed, std::size_t i) {
  const Record<double>& p = bed.position[i];
  const auto from = [](const Span& span, double origin) {
    return Span{span.low - origin, span.high - origin};
  };
  if (core.is_round) {
    const Span z = from(core.z, p.z);
    return sphere_tube_volume(p.w, distance_from(core.axis, p), core.radius, z.low, z.high);
  }
  return sphere_box_volume(p.w, from(core.x, p.x), from(core.y, p.y), from(core.z, p.z));
}
double volume_in(const Core& core, const PolyhedronBed& bed, std::size_t i) {
  if (core.is_round) {
    return polyhedron_tube_volume(bed.shape(i), bed.pose(i), core.axis, core.radius, core.z.low,
                                  core.z.high);
  }
  return box_volume(bed.shape(i), bed.pose(i), {core.x.low, core.y.low, core.z.low},
                    {core.x.high, core.y.high, core.z.high});
}

/// Volume of a grain below the plane at z.
double volume_below_z(const SphereBed& bed, std::size_t i, double z) {
  const Record<double>& p = bed.position[i];
  return sphere_slab_volume(p.w, -p.w, z - p.z);
}
double volume_below_z(const PolyhedronBed& bed, std::size_t i, double z) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return slab_volume(bed.shape(i), bed.pose(i), 2, -infinity, z);
}

Profile empty_profile(const Bins& bins) {
  return {bins.width, std::vector<ProfileBin>(static_cast<std::size_t>(bins.count))};
}

template <class Kind>
double highest_point(const Bed<Kind>& bed) {
  double top = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) top = std::max(top, span_of(bed, i, 2).high);
  return top;
}

template <class Kind>
Profile across(const Bed<Kind>& bed, const Touching& touching, const Slab& slab,
               const ProfileSettings& settings, int axis) {
  const Box& box = bed.box;
  const double width = axis == 0 ? box.length : box.width;
  const double other = axis == 0 ? box.width : box.length;
  const auto count = std::max<std::int64_t>(1, std::llround(width / settings.bin_width));
  const Bins bins{width / static_cast<double>(count), count,
                  (axis == 0 ? box.x : box.y) == Boundary::periodic};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Span upright = span_of(bed, i, 2);
    if (upright.high <= slab.bottom || upright.low >= slab.top) continue;
    add_volume(
        span_of(bed, i, axis), bins, class_of(bed.position[i], settings),
        [&](double top) { return volume_below(bed, i, axis, top, slab); }, profile);
  }
  divide_volumes(other * bins.width * slab.height(), profile);
  count_grains(bed, touching, settings, [&](const Record<double>& p) -> ProfileBin* {
    const double at = axis == 0 ? p.x : p.y;
    return slab.contains(p.z) ? &profile.bins[bins.index(bins.number_at(at))] : nullptr;
  });
  return profile;
}

double distance_from_walls(const Box& box, double x, double y) {
  const double from_x = x - box.length / 2.0, from_y = y - box.width / 2.0;
  if (box.is_tube) return box.length / 2.0 - std::sqrt(from_x * from_x + from_y * from_y);
  return std::min(std::min(x, box.length - x), std::min(y, box.width - y));
}

/// Radius of a ball about its centre that holds a grain, d.
double ball_radius(const SphereBed& bed, std::size_t i) { return bed.position[i].w; }
double ball_radius(const PolyhedronBed& bed, std::size_t i) { return bed.circumradius(i); }

/// How far a grain reaches towards the nearest upright wall, and away from it, d; no shorter than
/// it does.
template <class Kind>
Span reach_from_walls(const Bed<Kind>& bed, std::size_t i) {
  const Box& box = bed.box;
  if (box.is_tube) {
    const Record<double>& p = bed.position[i];
    const double at = distance_from_walls(box, p.x, p.y), radius = ball_radius(bed, i);
    return {at - radius, std::min(at + radius, box.length / 2.0)};
  }
  const Span x = span_of(bed, i, 0), y = span_of(bed, i, 1);
  return {
      std::min(distance_from_walls(box, x.low, y.low), distance_from_walls(box, x.high, y.high)),
      std::min({x.high, box.length - x.low, y.high, box.width - y.low})};
}

/// Area of the floor between two distances from the upright walls, d^2.
double frame_area(const Box& box, double low, double high) {
  return box.is_tube ? pi * (high - low) * (box.length - low - high)
                     : 2.0 * (high - low) * (box.length + box.width - 2.0 * (low + high));
}

template <class Kind>
Profile from_walls(const Bed<Kind>& bed, const Touching& touching, const Slab& slab,
                   const ProfileSettings& settings) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Box& box = bed.box;
  const double half = std::min(box.length, box.width) / 2.0;
  const auto count = std::max<std::int64_t>(1, std::llround(half / settings.bin_width));
  const Bins bins{half / static_cast<double>(count), count, false};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Span upright = span_of(bed, i, 2);
    if (upright.high <= slab.bottom || upright.low >= slab.top) continue;
    const double whole = volume_in(core_of(box, slab, -infinity), bed, i);
    add_volume(
        reach_from_walls(bed, i), bins, class_of(bed.position[i], settings),
        [&](double distance) {
          return distance >= half ? whole : whole - volume_in(core_of(box, slab, distance), bed, i);
        },
        profile);
  }
  for (std::int64_t k = 0; k < count; ++k) {
    const double low = static_cast<double>(k) * bins.width, high = low + bins.width;
    divide_volume(frame_area(box, low, high) * slab.height(),
                  profile.bins[static_cast<std::size_t>(k)]);
  }
  count_grains(bed, touching, settings, [&](const Record<double>& p) -> ProfileBin* {
    const double distance = distance_from_walls(box, p.x, p.y);
    return slab.contains(p.z) ? &profile.bins[bins.index(bins.number_at(distance))] : nullptr;
  });
  return profile;
}

template <class Kind>
Profile along_z(const Bed<Kind>& bed, const Touching& touching, const ProfileSettings& settings) {
  const double bins_up = std::ceil(highest_point(bed) / settings.bin_width);
  const Bins bins{settings.bin_width, std::max<std::int64_t>(1, std::llround(bins_up)), false};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    add_volume(
        span_of(bed, i, 2), bins, class_of(bed.position[i], settings),
        [&](double z) { return volume_below_z(bed, i, z); }, profile);
  }
  divide_volumes(bed.box.floor_area() * bins.width, profile);
  count_grains(bed, touching, settings, [&](const Record<double>& p) {
    return &profile.bins[bins.index(bins.number_at(p.z))];
  });
  return profile;
}

}  // namespace

template <class Kind>
Profile profile_across(const Bed<Kind>& bed, const Touching& touching, const Slab& slab,
                       const ProfileSettings& settings, int axis) {
  return across(bed, touching, slab, settings, axis);
}

template <class Kind>
Profile profile_from_walls(const Bed<Kind>& bed, const Touching& touching, const Slab& slab,
                           const ProfileSettings& settings) {
  return from_walls(bed, touching, slab, settings);
}

template <class Kind>
Profile profile_along_z(const Bed<Kind>& bed, const Touching& touching,
                        const ProfileSettings& settings) {
  return along_z(bed, touching, settings);
}

template Profile profile_across(const SphereBed&, const Touching&, const Slab&,
                                const ProfileSettings&, int);
template Profile profile_across(const PolyhedronBed&, const Touching&, const Slab&,
                                const ProfileSettings&, int);
template Profile profile_from_walls(const SphereBed&, const Touching&, const Slab&,
                                    const ProfileSettings&);
template Profile profile_from_walls(const PolyhedronBed&, const Touching&, const Slab&,
                                    const ProfileSettings&);
template Profile profile_along_z(const SphereBed&, const Touching&, const ProfileSettings&);
template Profile profile_along_z(const PolyhedronBed&, const Touching&, const ProfileSettings&);

}  // namespace grainsweep
