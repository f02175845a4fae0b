// A bed of spheres: the state that a packing carries from step to step.
//
// Spheres have a position, a radius, a mass and a displacement. They have no orientation, no
// inertia and no lever arms: without friction nothing can turn them, so nothing here could say that
// they do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/scene/spec.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Grains that a subdomain of a large bed holds or more; see engine/rows/subdomains.hpp.
inline constexpr std::size_t subdomain_grains = 4000;

/// Beds of fewer grains are one subdomain.
inline constexpr std::size_t large_bed_grains = 4 * subdomain_grains;

/// Most subdomains that a bed of so many grains is divided into.
constexpr std::size_t most_subdomains(std::size_t grains) {
  return grains < large_bed_grains ? 1 : grains / subdomain_grains + 1;
}

/// Axis along which a large bed is cut into subdomains: of a flat bed the longer one of x and y, 0
/// or 1; of others upwards, 2. `solid_volume`: of all grains, d^3.
int subdomain_axis(const Box& box, double solid_volume);

/// Columns of a bed. Each column ends with entries that are no grains, for each subdomain three:
/// the wall, which nothing moves, and two void grains far from everything, which fill unused lanes
/// of kernel blocks. Subdomains share none, so that cores may sweep them at the same time.
struct SphereBed {
  Box box;
  std::vector<Wall> walls;               ///< of the box, the floor first
  std::vector<Record<double>> position;  ///< x, y, z and radius, d; x and y may leave the box
  std::vector<Record<double>> motion;    ///< displacement of the last step, d, and inverse mass

  std::size_t subdomains = 1;  ///< most_subdomains of the grains
  int subdomain_axis = 2;      ///< see `subdomain_axis`

  std::size_t grains() const { return position.size() - 3 * subdomains; }
  std::int32_t wall(std::size_t subdomain = 0) const {
    return static_cast<std::int32_t>(grains() + subdomain);
  }
  std::int32_t void_a(std::size_t subdomain = 0) const {
    return static_cast<std::int32_t>(grains() + subdomains + 2 * subdomain);
  }
  std::int32_t void_b(std::size_t subdomain = 0) const { return void_a(subdomain) + 1; }
  bool is_void(std::int32_t entry) const { return entry >= void_a(); }
};

/// A bed at rest in mid-air: the given spheres, and the entries that are no grains.
SphereBed make_bed(const Box& box, const std::vector<PlacedSphere>& spheres);

/// Whether all four are finite numbers.
bool is_finite(const Record<double>& record);

/// Whether every grain's place, radius, motion and inverse mass is a finite number.
bool is_finite(const SphereBed& bed);

/// Brings x and y of every centre back into the box along periodic axes.
void wrap(SphereBed& bed);

/// The hash of what came before and a record, bit by bit.
std::uint64_t mixed(std::uint64_t hash, const Record<double>& record);

/// Hash of all positions, bit by bit.
std::uint64_t state_hash(const SphereBed& bed);

}  // namespace grainsweep
