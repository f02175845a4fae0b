#include "engine/scene/bed.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Far enough that no grain ever meets the void, near enough that squares stay finite.
constexpr double void_distance = 1e9;

std::uint64_t mixed_value(std::uint64_t hash, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;  // odd constant of Knuth's multiplicative hashing
  return hash ^ (hash >> 29);
}

}  // namespace

int subdomain_axis(const Box& box, double solid_volume) {
  constexpr double flat = 1.5;            // times as long as high: worth other subdomains
  constexpr double solid_fraction = 0.6;  // about that of all settled beds
  const double height = solid_volume / (solid_fraction * box.length * box.width);
  const int longer = box.length >= box.width ? 0 : 1;
  return std::max(box.length, box.width) > flat * height ? longer : 2;
}

SphereBed make_bed(const Box& box, const std::vector<PlacedSphere>& spheres) {
  double volume = 0.0;
  for (const PlacedSphere& s : spheres) volume += sphere_volume(s.radius);
  SphereBed bed{
      box, walls_of(box), {}, {}, most_subdomains(spheres.size()), subdomain_axis(box, volume)};
  const std::size_t entries = spheres.size() + 3 * bed.subdomains;
  bed.position.reserve(entries);
  bed.motion.reserve(entries);
  for (const PlacedSphere& s : spheres) {
    bed.position.push_back({s.x, s.y, s.z, s.radius});
    bed.motion.push_back({0.0, 0.0, 0.0, 1.0 / sphere_mass(s.radius)});
  }
  bed.position.insert(bed.position.end(), bed.subdomains, {0.0, 0.0, -void_distance, 0.0});
  bed.motion.insert(bed.motion.end(), bed.subdomains, {0.0, 0.0, 0.0, 0.0});
  for (std::size_t subdomain = 0; subdomain < bed.subdomains; ++subdomain) {
    bed.position.insert(bed.position.end(), {{0.0, 0.0, -2.0 * void_distance, 0.0},
                                             {0.0, 0.0, -3.0 * void_distance, 0.0}});
    bed.motion.insert(bed.motion.end(), {{0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 1.0}});
  }
  return bed;
}

bool is_finite(const Record<double>& r) {
  return std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z) && std::isfinite(r.w);
}

bool is_finite(const SphereBed& bed) {
  const auto finite = [](const Record<double>& r) { return is_finite(r); };
  return std::all_of(bed.position.begin(), bed.position.end(), finite) &&
         std::all_of(bed.motion.begin(), bed.motion.end(), finite);
}

void wrap(SphereBed& bed) {
  for (std::size_t i = 0; i < bed.grains(); ++i) wrap(bed.box, bed.position[i]);
}

std::uint64_t mixed(std::uint64_t hash, const Record<double>& r) {
  return mixed_value(mixed_value(mixed_value(mixed_value(hash, r.x), r.y), r.z), r.w);
}

std::uint64_t state_hash(const SphereBed& bed) {
  std::uint64_t hash = bed.grains();
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    hash = mixed(hash, bed.position[i]);
  }
  return hash;
}

}  // namespace grainsweep
