// A bed of spheres: the state that a packing carries from step to step.
//
// Spheres have a position, a radius, a mass and a displacement. They have no orientation, no
// inertia and no lever arms: without friction nothing can turn them, so nothing here could say that
// they do.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/scene/spec.hpp"
#include "kernels/kernels.hpp"

namespace grainsweep {

/// Floor at z = 0; x in [0, length], y in [0, width]; each either walled or periodic.
struct Box {
  double length = 0.0;  ///< d
  double width = 0.0;   ///< d
  Boundary x = Boundary::periodic;
  Boundary y = Boundary::walls;

  /// Period of an axis, d; 0 where it is walled.
  double period_x() const { return x == Boundary::periodic ? length : 0.0; }
  double period_y() const { return y == Boundary::periodic ? width : 0.0; }
};

/// Nearest image of a difference of coordinates along an axis of that period; 0: as it is.
inline double nearest(double difference, double period) {
  return period > 0.0 ? difference - period * std::nearbyint(difference / period) : difference;
}

/// Grains that a section of a large bed holds or more; see engine/contact/sections.hpp.
inline constexpr std::size_t section_grains = 4000;

/// Beds of fewer grains are one section.
inline constexpr std::size_t large_bed_grains = 4 * section_grains;

/// Most sections that a bed of so many grains is divided into.
constexpr std::size_t most_sections(std::size_t grains) {
  return grains < large_bed_grains ? 1 : grains / section_grains + 1;
}

/// Axis along which a large bed is cut into sections: of a flat bed the longer one of x and y, 0 or
/// 1; of others upwards, 2. `solid_volume`: of all grains, d^3.
int section_axis(const Box& box, double solid_volume);

/// Columns of a bed. Each column ends with entries that are no grains, for each section three: the
/// wall, which nothing moves, and two void grains far from everything, which fill unused lanes of
/// kernel blocks. Sections share none, so that cores may sweep them at the same time.
struct SphereBed {
  Box box;
  std::vector<Record<double>> position;  ///< x, y, z and radius, d; x and y may leave the box
  std::vector<Record<double>> motion;    ///< displacement of the last step, d, and inverse mass

  std::size_t sections = 1;  ///< most_sections of the grains
  int section_axis = 2;      ///< see `section_axis`

  std::size_t grains() const { return position.size() - 3 * sections; }
  std::int32_t wall(std::size_t section = 0) const {
    return static_cast<std::int32_t>(grains() + section);
  }
  std::int32_t void_a(std::size_t section = 0) const {
    return static_cast<std::int32_t>(grains() + sections + 2 * section);
  }
  std::int32_t void_b(std::size_t section = 0) const { return void_a(section) + 1; }
  bool is_void(std::int32_t entry) const { return entry >= void_a(); }
};

/// A bed at rest in mid-air: the given spheres, and the entries that are no grains.
SphereBed make_bed(const Box& box, const std::vector<PlacedSphere>& spheres);

/// Whether all four are finite numbers.
bool is_finite(const Record<double>& record);

/// Whether every grain's place, radius, motion and inverse mass is a finite number.
bool is_finite(const SphereBed& bed);

/// Brings x and y of a centre, or of every grain's, back into the box along periodic axes.
void wrap(const Box& box, Record<double>& centre);
void wrap(SphereBed& bed);

/// The hash of what came before and a record, bit by bit.
std::uint64_t mixed(std::uint64_t hash, const Record<double>& record);

/// Hash of all positions, bit by bit.
std::uint64_t state_hash(const SphereBed& bed);

}  // namespace grainsweep
