#include "engine/measure/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

/// Adds the volume of one sphere to the bins it reaches; `below(t)` is its volume below the plane
/// at t from its centre. Differences of one function: nothing is lost between bins.
template <class Below>
void add_volume(double centre, double radius, const Bins& bins, double ProfileBin::*member,
                Below below, Profile& profile) {
  const std::int64_t last = bins.number_at(centre + radius);
  double before = 0.0;
  for (std::int64_t k = bins.number_at(centre - radius); k <= last; ++k) {
    const double edge = static_cast<double>(k + 1) * bins.width - centre;
    const double volume = below(k == last ? radius : edge);
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

/// Volume of a sphere below a plane across y, as far as it lies in the slab.
double volume_in_slab(const Record<double>& sphere, const Slab& slab, double top) {
  const double low = slab.bottom - sphere.z, high = slab.top - sphere.z;
  if (low <= -sphere.w && high >= sphere.w) {
    return sphere_slab_volume(sphere.w, -sphere.w, top);
  }
  return sphere_beam_volume(sphere.w, top, low, high);
}

double highest_point(const SphereBed& bed) {
  double top = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    top = std::max(top, bed.position[i].z + bed.position[i].w);
  }
  return top;
}

Profile empty_profile(const Bins& bins) {
  return {bins.width, std::vector<ProfileBin>(static_cast<std::size_t>(bins.count))};
}

}  // namespace

Profile profile_along_y(const SphereBed& bed, const Touching& touching, const Slab& slab,
                        const ProfileSettings& settings) {
  const double width = bed.box.width;
  const auto count = std::max<std::int64_t>(1, std::llround(width / settings.bin_width));
  const Bins bins{width / static_cast<double>(count), count, bed.box.y == Boundary::periodic};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    if (p.z + p.w <= slab.bottom || p.z - p.w >= slab.top) continue;
    add_volume(
        p.y, p.w, bins, class_of(p, settings),
        [&](double top) { return volume_in_slab(p, slab, top); }, profile);
  }
  divide_volumes(bed.box.length * bins.width * slab.height(), profile);
  count_grains(bed, touching, settings, [&](const Record<double>& p) -> ProfileBin* {
    const bool inside = slab.bottom <= p.z && p.z < slab.top;
    return inside ? &profile.bins[bins.index(bins.number_at(p.y))] : nullptr;
  });
  return profile;
}

Profile profile_along_z(const SphereBed& bed, const Touching& touching,
                        const ProfileSettings& settings) {
  const double bins_up = std::ceil(highest_point(bed) / settings.bin_width);
  const Bins bins{settings.bin_width, std::max<std::int64_t>(1, std::llround(bins_up)), false};
  Profile profile = empty_profile(bins);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    add_volume(
        p.z, p.w, bins, class_of(p, settings),
        [&](double top) { return sphere_slab_volume(p.w, -p.w, top); }, profile);
  }
  divide_volumes(bed.box.length * bed.box.width * bins.width, profile);
  count_grains(bed, touching, settings, [&](const Record<double>& p) {
    return &profile.bins[bins.index(bins.number_at(p.z))];
  });
  return profile;
}

}  // namespace grainsweep
