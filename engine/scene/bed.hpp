// A bed: the state that a packing carries from step to step, by the kind of its grains.
//
// All grains have a position, a size, a mass and a displacement. Polyhedra also have an
// orientation, an angle vector and moments of inertia. Spheres have none of these: without friction
// nothing can turn them, so a bed has no place to say that they do.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/context.hpp"
#include "engine/scene/box.hpp"
#include "engine/scene/spec.hpp"
#include "engine/shape/pose.hpp"
#include "engine/units.hpp"

namespace grainsweep {

/// The kinds of grains. A bed holds one kind.
struct Sphere {
  static constexpr int degrees_of_freedom = 3;
  /// Least grains of a subdomain of a large bed, but for the last; see engine/rows/subdomains.hpp.
  static constexpr std::size_t subdomain_grains = 4000;
};
struct Polyhedron {
  static constexpr int degrees_of_freedom = 6;  ///< at most: spheres among polyhedra do not turn
  static constexpr std::size_t subdomain_grains = 1000;  ///< their steps cost more
};

/// Beds of fewer grains are one subdomain.
template <class Kind>
inline constexpr std::size_t large_bed_grains = 4 * Kind::subdomain_grains;

/// Largest number of subdomains that a bed of `grains` grains is divided into.
template <class Kind>
constexpr std::size_t max_subdomains(std::size_t grains) {
  return grains < large_bed_grains<Kind> ? 1 : grains / Kind::subdomain_grains + 1;
}

/// Height to which grains of that total volume, d^3, usually settle, d.
double usual_height(const Box& box, double solid_volume);

/// Axis along which a large bed is cut into subdomains: the longer of x and y, 0 or 1, if the bed
/// is flat, else z, 2. `solid_volume`: of all grains, d^3.
int subdomain_axis(const Box& box, double solid_volume);

/// What grains of all kinds have: columns with an entry per grain. The columns end with entries
/// that are not grains, three for each subdomain: the wall, which nothing moves, and two void
/// grains far from everything, which fill unused lanes of kernel blocks. Subdomains share none of
/// these, so that cores may sweep them at the same time.
struct Grains {
  Box box;
  std::vector<Wall> walls;               ///< of the box, the floor first
  std::vector<Record<double>> position;  ///< x, y, z and radius (of a polyhedron half its scale),
                                         ///< d; x and y may leave the box
  std::vector<Record<double>> motion;    ///< displacement of the last step, d, and inverse mass

  /// 1 for each grain that nothing moves for now (engine/dynamics/sleep.hpp); empty if all may
  /// move.
  std::vector<std::uint8_t> asleep;
  std::size_t first_awake = 0;  ///< all grains before it sleep
  /// Mass over inertia of each grain while the bed creeps, or spheres ease on
  /// (engine/dynamics/inertia.hpp), at least 1; empty if inertia is mass.
  std::vector<double> lightness;

  std::size_t subdomains = 1;  ///< max_subdomains of the grains
  int subdomain_axis = 2;      ///< see `subdomain_axis`

  std::size_t grains() const { return position.size() - 3 * subdomains; }
  /// The positions of the grains alone.
  std::span<const Record<double>> centres() const { return {position.data(), grains()}; }
  bool is_grain(std::int32_t entry) const { return entry < wall(); }
  std::int32_t wall(std::size_t subdomain = 0) const {
    return static_cast<std::int32_t>(grains() + subdomain);
  }
  std::int32_t void_a(std::size_t subdomain = 0) const {
    return static_cast<std::int32_t>(grains() + subdomains + 2 * subdomain);
  }
  std::int32_t void_b(std::size_t subdomain = 0) const { return void_a(subdomain) + 1; }
  bool is_asleep(std::size_t grain) const { return !asleep.empty() && asleep[grain] != 0; }
  /// Inverse mass of an entry as contacts see it, 1/m: 0 for a grain that sleeps.
  double inverse_mass(std::int32_t entry) const {
    const auto i = static_cast<std::size_t>(entry);
    return is_grain(entry) && is_asleep(i) ? 0.0 : motion[i].w;
  }
  /// Mass over inertia of a grain.
  double lightness_of(std::size_t grain) const {
    return lightness.empty() ? 1.0 : lightness[grain];
  }
  /// Longest way that a grain falls freely from rest in a step, d.
  double longest_drop(double dt) const {
    const auto lightest = std::max_element(lightness.begin(), lightness.end());
    return (lightest == lightness.end() ? 1.0 : *lightest) * dt * dt;
  }
  /// 1 over what resists the motion of an entry, 1/m.
  double inverse_inertia(std::int32_t entry) const {
    return (is_grain(entry) ? lightness_of(static_cast<std::size_t>(entry)) : 1.0) *
           inverse_mass(entry);
  }
  bool is_void(std::int32_t entry) const { return entry >= void_a(); }
  /// The number that stands for walls[k] as the second side of a contact.
  std::int32_t wall_name(std::size_t k) const { return static_cast<std::int32_t>(grains() + k); }
};

template <class Kind>
struct Bed;

template <>
struct Bed<Sphere> : Grains {
  // As those of polyhedra, for what is the same for both.
  std::size_t component(std::size_t /*grain*/) const { return 0; }
  double circumradius(std::size_t grain) const { return position[grain].w; }
  bool turns(std::size_t /*grain*/) const { return false; }
};
using SphereBed = Bed<Sphere>;

/// Grains of one convex shape, or of several: the components of a mixture, spheres among them. The
/// mass of a grain of scale s is s^3 times its component's volume over that of the first (so that a
/// grain of scale 1 of the first has mass 1); its principal moments are s^2 times that mass times
/// the component's `inertia`.
template <>
struct Bed<Polyhedron> : Grains {
  std::vector<ConvexShape> shapes;  ///< one for each component
  /// Place of each grain's shape in `shapes`; empty if there is only one.
  std::vector<std::uint8_t> components;
  /// Unit quaternion x, y, z, w: shape frame to box frame.
  std::vector<Record<double>> orientation;
  /// Angle vector of the next step if nothing acts, grain frame, radians.
  std::vector<Vector> spin;
  /// Square roots of the principal moments, sqrt(m) d; within a step, of moments that are increased
  /// (hold_turning in engine/rows/polyhedron_contacts.hpp).
  std::vector<Vector> root_inertia;

  double scale(std::size_t grain) const { return 2.0 * position[grain].w; }
  Pose pose(std::size_t grain) const { return pose_of(position[grain], orientation[grain]); }
  /// From the frame in which its shape is written to the box frame.
  Quaternion given_orientation(std::size_t grain) const {
    return pose(grain).orientation * Quaternion(shape(grain).given.rotation).conjugate();
  }
  std::size_t component(std::size_t grain) const {
    return components.empty() ? 0 : components[grain];
  }
  const ConvexShape& shape(std::size_t grain) const { return shapes[component(grain)]; }
  double circumradius(std::size_t grain) const { return scale(grain) * shape(grain).circumradius; }
  double inradius(std::size_t grain) const { return scale(grain) * shape(grain).inradius; }
  /// Whether forces can turn it: without friction nothing turns the spheres of a mixture.
  bool turns(std::size_t grain) const { return !shape(grain).is_ball; }
};
using PolyhedronBed = Bed<Polyhedron>;

/// Ways in which the grains can move: 3 for a sphere, 6 for a polyhedron.
std::int64_t degrees_of_freedom(const SphereBed& bed);
std::int64_t degrees_of_freedom(const PolyhedronBed& bed);

/// A bed at rest in mid-air: the given spheres, and the entries that are not grains.
SphereBed make_bed(const Box& box, const std::vector<PlacedSphere>& spheres);

/// The same with grains of these shapes; `components` says which shape each grain has, and is empty
/// if there is only one. Requires unit quaternions and positive scales.
PolyhedronBed make_bed(const Box& box, std::vector<ConvexShape> shapes,
                       std::vector<std::uint8_t> components, const std::vector<Pose>& poses);

/// Solid volume of a grain, d^3.
inline double volume_of(const SphereBed& bed, std::size_t grain) {
  return sphere_volume(bed.position[grain].w);
}
inline double volume_of(const PolyhedronBed& bed, std::size_t grain) {
  return bed.shape(grain).volume_at(bed.scale(grain));
}

/// Principal moments of inertia of a grain, m d^2.
Vector principal_moments(const PolyhedronBed& bed, std::size_t grain);

/// Whether every grain's place, size, motion and inverse mass, and orientation and angle vector if
/// it has one, are finite numbers.
bool is_finite(const SphereBed& bed);
bool is_finite(const PolyhedronBed& bed);

/// Brings x and y of every centre back into the box along periodic axes.
void wrap(Grains& bed, const ParallelFor& loop = serial_for);

/// Place q minus place p, for their nearest images, box frame, d.
Vector nearest_difference(const Box& box, const Record<double>& p, const Record<double>& q);

/// Centre of grain b minus that of grain a, in the same way.
Vector nearest_difference(const Grains& bed, std::size_t a, std::size_t b);

/// Grain b, at its nearest image, as grain a sees it.
PairPose pair_pose(const PolyhedronBed& bed, std::size_t a, std::size_t b);

/// Moves a grain by `displacement` (d, box frame) and turns it by the angle vector `angles`
/// (radians, grain frame), exactly; both become its motion. The angle vector is carried on so that
/// a free grain keeps its angular momentum.
void move_grain(PolyhedronBed& bed, std::size_t grain, const Vector& displacement,
                const Vector& angles);

/// Hash of all positions and sizes, and orientations if there are any, bit by bit.
std::uint64_t state_hash(const SphereBed& bed);
std::uint64_t state_hash(const PolyhedronBed& bed);

}  // namespace grainsweep
