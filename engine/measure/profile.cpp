#include "engine/measure/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/measure/cut_polyhedron.hpp"
#include "engine/measure/cut_sphere.hpp"

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
void divide_volumes(double bin_volume, Profile& profile) {
  for (ProfileBin& bin : profile.bins) {
    bin.large /= bin_volume;
    bin.small /= bin_volume;
  }
}

/// Counts grains and what they touch; `bin_of(sphere)` is the bin, or null outside.
template <class BinOf>
void count_grains(const SphereBed& bed, const Touching& touching, const ProfileSettings& settings,
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

Span span_of(double centre, double radius) { return {centre - radius, centre + radius}; }

/// Volume of a sphere below a plane across y, as far as it lies in the slab.
double volume_in_slab(const Record<double>& sphere, const Slab& slab, double top) {
  const double low = slab.bottom - sphere.z, high = slab.top - sphere.z;
  if (low <= -sphere.w && high >= sphere.w) {
    return sphere_slab_volume(sphere.w, -sphere.w, top);
  }
  return sphere_beam_volume(sphere.w, top, low, high);
}

/// The grains of a bed as profiles see them: how far each reaches along y and z, and how much of it
/// lies below a plane.
class Spheres {
 public:
  explicit Spheres(const SphereBed& bed) : bed_(bed) {}

  Span along_y(std::size_t i) const { return span_of(bed_.position[i].y, bed_.position[i].w); }
  Span along_z(std::size_t i) const { return span_of(bed_.position[i].z, bed_.position[i].w); }
  double below_y(std::size_t i, double y, const Slab& slab) const {
    return volume_in_slab(bed_.position[i], slab, y - bed_.position[i].y);
  }
  double below_z(std::size_t i, double z) const {
    const Record<double>& p = bed_.position[i];
    return sphere_slab_volume(p.w, -p.w, z - p.z);
  }

 private:
  const SphereBed& bed_;
};

class Polyhedra {
 public:
  explicit Polyhedra(const ShapeBed& bed) : bed_(bed) {}

  Span along_y(std::size_t i) const { return span_along(bed_.shape, bed_.pose(i), 1); }
  Span along_z(std::size_t i) const { return span_along(bed_.shape, bed_.pose(i), 2); }
  double below_y(std::size_t i, double y, const Slab& slab) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return box_volume(bed_.shape, bed_.pose(i), {-infinity, -infinity, slab.bottom},
                      {infinity, y, slab.top});
  }
  double below_z(std::size_t i, double z) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return slab_volume(bed_.shape, bed_.pose(i), 2, -infinity, z);
  }

 private:
  const ShapeBed& bed_;
};

Profile empty_profile(const Bins& bins) {
  return {bins.width, std::vector<ProfileBin>(static_cast<std::size_t>(bins.count))};
}

/// `centres`: where the grains are, with their radii or half sizes.
template <class Grains>
Profile along_y(const Grains& grains, const SphereBed& centres, const Touching& touching,
                const Slab& slab, const ProfileSettings& settings) {
  const double width = centres.box.width;
  const auto count = std::max<std::int64_t>(1, std::llround(width / settings.bin_width));
  const Bins bins{width / static_cast<double>(count), count, centres.box.y == Boundary::periodic};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < centres.grains(); ++i) {
    const Span upright = grains.along_z(i);
    if (upright.high <= slab.bottom || upright.low >= slab.top) continue;
    add_volume(
        grains.along_y(i), bins, class_of(centres.position[i], settings),
        [&](double y) { return grains.below_y(i, y, slab); }, profile);
  }
  divide_volumes(centres.box.length * bins.width * slab.height(), profile);
  count_grains(centres, touching, settings, [&](const Record<double>& p) -> ProfileBin* {
    const bool inside = slab.bottom <= p.z && p.z < slab.top;
    return inside ? &profile.bins[bins.index(bins.number_at(p.y))] : nullptr;
  });
  return profile;
}

template <class Grains>
double highest_point(const Grains& grains, std::size_t count) {
  double top = 0.0;
  for (std::size_t i = 0; i < count; ++i) top = std::max(top, grains.along_z(i).high);
  return top;
}

template <class Grains>
Profile along_z(const Grains& grains, const SphereBed& centres, const Touching& touching,
                const ProfileSettings& settings) {
  const double bins_up = std::ceil(highest_point(grains, centres.grains()) / settings.bin_width);
  const Bins bins{settings.bin_width, std::max<std::int64_t>(1, std::llround(bins_up)), false};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < centres.grains(); ++i) {
    add_volume(
        grains.along_z(i), bins, class_of(centres.position[i], settings),
        [&](double z) { return grains.below_z(i, z); }, profile);
  }
  divide_volumes(centres.box.length * centres.box.width * bins.width, profile);
  count_grains(centres, touching, settings, [&](const Record<double>& p) {
    return &profile.bins[bins.index(bins.number_at(p.z))];
  });
  return profile;
}

}  // namespace

Profile profile_along_y(const SphereBed& bed, const Touching& touching, const Slab& slab,
                        const ProfileSettings& settings) {
  return along_y(Spheres(bed), bed, touching, slab, settings);
}
Profile profile_along_y(const ShapeBed& bed, const SphereBed& centres, const Touching& touching,
                        const Slab& slab, const ProfileSettings& settings) {
  return along_y(Polyhedra(bed), centres, touching, slab, settings);
}

Profile profile_along_z(const SphereBed& bed, const Touching& touching,
                        const ProfileSettings& settings) {
  return along_z(Spheres(bed), bed, touching, settings);
}
Profile profile_along_z(const ShapeBed& bed, const SphereBed& centres, const Touching& touching,
                        const ProfileSettings& settings) {
  return along_z(Polyhedra(bed), centres, touching, settings);
}

}  // namespace grainsweep
