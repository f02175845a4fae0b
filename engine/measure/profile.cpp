#include "engine/measure/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/measure/cut_sphere.hpp"
#include "engine/measure/cut_tube.hpp"
#include "engine/measure/nematic.hpp"
#include "engine/measure/solid_fraction.hpp"
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

/// Number of the bin of each grain, none outside; `bin_of(centre)` gives it.
using BinOfGrain = std::vector<std::optional<std::size_t>>;
template <class BinOf>
BinOfGrain bins_of_grains(const Grains& bed, BinOf bin_of) {
  BinOfGrain bins(bed.grains());
  for (std::size_t i = 0; i < bins.size(); ++i) bins[i] = bin_of(bed.position[i]);
  return bins;
}

/// Gathers the profile of all grains, by size class.
template <class Kind>
class OfClasses {
 public:
  using Gathered = Profile;

  OfClasses(const Bed<Kind>& bed, const ProfileSettings& settings)
      : bed_(bed), settings_(settings) {}

  void begin(const Bins& bins) {
    profile_ = {bins.width, std::vector<ProfileBin>(static_cast<std::size_t>(bins.count))};
  }
  void add_volume(std::size_t grain, std::size_t bin, double volume) {
    const bool small = is_small(bed_.position[grain], settings_);
    (small ? profile_.bins[bin].small : profile_.bins[bin].large) += volume;
  }
  void divide_volume(std::size_t bin, double bin_volume) {
    profile_.bins[bin].large /= bin_volume;
    profile_.bins[bin].small /= bin_volume;
  }
  void count(const Touching& touching, const BinOfGrain& bins) {
    auto& in = profile_.bins;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (!bins[i]) continue;
      ++(is_small(bed_.position[i], settings_) ? in[*bins[i]].small_grains
                                               : in[*bins[i]].large_grains);
    }
    visit_touching(
        touching, settings_.gap_tolerance,
        [&](std::size_t grain, std::size_t) {
          if (bins[grain]) ++in[*bins[grain]].neighbours;
        },
        [&](std::size_t grain) {
          if (bins[grain]) ++in[*bins[grain]].walls;
        });
  }
  Profile result() { return std::move(profile_); }

 private:
  const Bed<Kind>& bed_;
  const ProfileSettings& settings_;
  Profile profile_;
};

/// Gathers the profile of each component of a mixture.
class OfComponents {
 public:
  using Gathered = std::vector<ComponentProfile>;

  OfComponents(const PolyhedronBed& bed, const ProfileSettings& settings)
      : bed_(bed), gap_tolerance_(settings.gap_tolerance) {}

  void begin(const Bins& bins) {
    ComponentBin empty;
    empty.neighbours.resize(bed_.shapes.size());
    profiles_.assign(bed_.shapes.size(),
                     {bins.width, {static_cast<std::size_t>(bins.count), empty}});
  }
  void add_volume(std::size_t grain, std::size_t bin, double volume) {
    at(grain, bin).solid_fraction += volume;
  }
  void divide_volume(std::size_t bin, double bin_volume) {
    for (ComponentProfile& profile : profiles_) profile.bins[bin].solid_fraction /= bin_volume;
  }
  void count(const Touching& touching, const BinOfGrain& bins) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (bins[i]) ++at(i, *bins[i]).grains;
    }
    visit_touching(
        touching, gap_tolerance_,
        [&](std::size_t grain, std::size_t other) {
          if (bins[grain]) ++at(grain, *bins[grain]).neighbours[bed_.component(other)];
        },
        [&](std::size_t grain) {
          if (bins[grain]) ++at(grain, *bins[grain]).walls;
        });
    set_nematic(bins);
  }
  std::vector<ComponentProfile> result() { return std::move(profiles_); }

 private:
  ComponentBin& at(std::size_t grain, std::size_t bin) {
    return profiles_[bed_.component(grain)].bins[bin];
  }
  /// Sets the nematic order in each bin of each component.
  void set_nematic(const BinOfGrain& bins) {
    const std::size_t count = profiles_.front().bins.size();
    std::vector<std::vector<std::size_t>> grains(profiles_.size() * count);
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (bins[i]) grains[bed_.component(i) * count + *bins[i]].push_back(i);
    }
    for (std::size_t k = 0; k < grains.size(); ++k) {
      profiles_[k / count].bins[k % count].nematic = nematic_orders(bed_, grains[k]);
    }
  }

  const PolyhedronBed& bed_;
  double gap_tolerance_;
  std::vector<ComponentProfile> profiles_;
};

/// Adds the volume of one grain to the bins it reaches; `below(t)` is its volume below the plane at
/// t, all of it for t infinite. The volumes are differences of one function, kept from falling by
/// rounding: nothing is lost between bins, and no volume is negative.
template <class Below, class Gather>
void add_volume(std::size_t grain, const Span& span, const Bins& bins, Below below,
                Gather& gather) {
  const std::int64_t last = bins.number_at(span.high);
  double before = 0.0;
  for (std::int64_t k = bins.number_at(span.low); k <= last; ++k) {
    const double end = k == last ? infinity : static_cast<double>(k + 1) * bins.width;
    const double volume = std::max(before, below(end));
    gather.add_volume(grain, bins.index(k), volume - before);
    before = volume;
  }
}

/// Turns volumes into solid fractions; all bins have this volume.
template <class Gather>
void divide_volumes(const Bins& bins, double bin_volume, Gather& gather) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(bins.count); ++k) {
    gather.divide_volume(k, bin_volume);
  }
}

/// Volume of the part of a sphere below a plane across x or y and within the slab.
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

/// The bin of a centre at height z of the slab; none above and below.
std::optional<std::size_t> bin_in(const Slab& slab, const Bins& bins, double z, double coordinate) {
  if (!slab.contains(z)) return std::nullopt;
  return bins.index(bins.number_at(coordinate));
}

template <class Kind>
double highest_point(const Bed<Kind>& bed) {
  double top = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) top = std::max(top, span_of(bed, i, 2).high);
  return top;
}

template <class Kind, class Gather>
typename Gather::Gathered gathered_across(const Bed<Kind>& bed, const Touching& touching,
                                          const Slab& slab, const ProfileSettings& settings,
                                          int axis, Gather gather) {
  const Box& box = bed.box;
  const double width = axis == 0 ? box.length : box.width;
  const double other = axis == 0 ? box.width : box.length;
  const auto count = std::max<std::int64_t>(1, std::llround(width / settings.bin_width));
  const Bins bins{width / static_cast<double>(count), count,
                  (axis == 0 ? box.x : box.y) == Boundary::periodic};
  gather.begin(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Span upright = span_of(bed, i, 2);
    if (upright.high <= slab.bottom || upright.low >= slab.top) continue;
    add_volume(
        i, span_of(bed, i, axis), bins,
        [&](double top) { return volume_below(bed, i, axis, top, slab); }, gather);
  }
  divide_volumes(bins, other * bins.width * slab.height(), gather);
  gather.count(touching, bins_of_grains(bed, [&](const Record<double>& p) {
                 return bin_in(slab, bins, p.z, axis == 0 ? p.x : p.y);
               }));
  return gather.result();
}

double distance_from_walls(const Box& box, double x, double y) {
  const double from_x = x - box.length / 2.0, from_y = y - box.width / 2.0;
  if (box.is_tube) return box.length / 2.0 - std::sqrt(from_x * from_x + from_y * from_y);
  return std::min(std::min(x, box.length - x), std::min(y, box.width - y));
}

/// How far a grain reaches towards the nearest upright wall, and away from it, d; upper bounds.
template <class Kind>
Span reach_from_walls(const Bed<Kind>& bed, std::size_t i) {
  const Box& box = bed.box;
  if (box.is_tube) {
    const Record<double>& p = bed.position[i];
    const double at = distance_from_walls(box, p.x, p.y), radius = bed.circumradius(i);
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

template <class Kind, class Gather>
typename Gather::Gathered from_walls(const Bed<Kind>& bed, const Touching& touching,
                                     const Slab& slab, const ProfileSettings& settings,
                                     Gather gather) {
  const Box& box = bed.box;
  const double half = std::min(box.length, box.width) / 2.0;
  const auto count = std::max<std::int64_t>(1, std::llround(half / settings.bin_width));
  const Bins bins{half / static_cast<double>(count), count, false};
  gather.begin(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Span upright = span_of(bed, i, 2);
    if (upright.high <= slab.bottom || upright.low >= slab.top) continue;
    const double whole = volume_in(core_of(box, slab, -infinity), bed, i);
    add_volume(
        i, reach_from_walls(bed, i), bins,
        [&](double distance) {
          return distance >= half ? whole : whole - volume_in(core_of(box, slab, distance), bed, i);
        },
        gather);
  }
  for (std::int64_t k = 0; k < count; ++k) {
    const double low = static_cast<double>(k) * bins.width, high = low + bins.width;
    gather.divide_volume(static_cast<std::size_t>(k), frame_area(box, low, high) * slab.height());
  }
  gather.count(touching, bins_of_grains(bed, [&](const Record<double>& p) {
                 return bin_in(slab, bins, p.z, distance_from_walls(box, p.x, p.y));
               }));
  return gather.result();
}

template <class Kind, class Gather>
typename Gather::Gathered along_z(const Bed<Kind>& bed, const Touching& touching,
                                  const ProfileSettings& settings, Gather gather) {
  const double bins_up = std::ceil(highest_point(bed) / settings.bin_width);
  const Bins bins{settings.bin_width, std::max<std::int64_t>(1, std::llround(bins_up)), false};
  gather.begin(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    add_volume(
        i, span_of(bed, i, 2), bins,
        [&](double z) {
          return volume_in(Slab{-infinity, z}, bed, i);
        },
        gather);
  }
  divide_volumes(bins, bed.box.floor_area() * bins.width, gather);
  gather.count(touching, bins_of_grains(bed, [&](const Record<double>& p) {
                 return std::optional(bins.index(bins.number_at(p.z)));
               }));
  return gather.result();
}

template <class Kind, class Gather>
typename Gather::Gathered along(ProfileAxis axis, const Bed<Kind>& bed, const Touching& touching,
                                const Slab& slab, const ProfileSettings& settings, Gather gather) {
  switch (axis) {
    case ProfileAxis::x:
      return gathered_across(bed, touching, slab, settings, 0, gather);
    case ProfileAxis::y:
      return gathered_across(bed, touching, slab, settings, 1, gather);
    case ProfileAxis::from_walls:
      return from_walls(bed, touching, slab, settings, gather);
    case ProfileAxis::z:
      break;
  }
  return along_z(bed, touching, settings, gather);
}

}  // namespace

template <class Kind>
Profile profile_along(ProfileAxis axis, const Bed<Kind>& bed, const Touching& touching,
                      const Slab& slab, const ProfileSettings& settings) {
  return along(axis, bed, touching, slab, settings, OfClasses(bed, settings));
}

std::vector<ComponentProfile> component_profiles(ProfileAxis axis, const PolyhedronBed& bed,
                                                 const Touching& touching, const Slab& slab,
                                                 const ProfileSettings& settings) {
  return along(axis, bed, touching, slab, settings, OfComponents(bed, settings));
}

template Profile profile_along(ProfileAxis, const SphereBed&, const Touching&, const Slab&,
                               const ProfileSettings&);
template Profile profile_along(ProfileAxis, const PolyhedronBed&, const Touching&, const Slab&,
                               const ProfileSettings&);

}  // namespace grainsweep
