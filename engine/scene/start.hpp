// The start of a packing: grains loose in the air, spheres touching none.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/scene/bed.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Solid fraction of the column in which grains are placed at random. Where they cannot stand so
/// densely without order, as between walls less than two diameters apart, the column is made 1.5
/// times as high until they have room.
inline constexpr double sphere_start_solid_fraction = 0.25;
inline constexpr double polyhedron_start_solid_fraction = 0.4;

/// Radius of the balls that keep the centres of polyhedra apart at the start, in radii of the
/// sphere that has the grain's volume. Corners of neighbours overlap; the fall parts them by a
/// share of the overlap a step.
inline constexpr double start_ball = 0.7;

/// As many grains as `spec` asks for, placed one after the other at random where they (polyhedra:
/// their balls) overlap no other (random sequential addition), in a column above the floor; the
/// orientations of polyhedra are uniform over all rotations, and their scales are drawn as
/// diameters of spheres are; which grain of a mixture is of which component is drawn as well. In a
/// tube that holds spheres in single file only, they lie in one plane, on either side in turn.
/// Grains placed by the user are taken where and as they are placed. Grains that were drawn are
/// numbered from the floor up, in large flat beds first along x or y. Empty if a grain is larger
/// than the gap between walls.
template <class Kind>
std::optional<Bed<Kind>> start(const PackingSpec& spec);

/// A sphere, and which it is of those that were to be placed, from 0.
struct NumberedSphere : PlacedSphere {
  std::size_t number = 0;
};

/// Spheres of these radii, at least one, placed in the same way in a column from the floor to
/// `height`, d, or to one and a half of the largest diameter, or higher. Sorted from the floor up.
std::optional<std::vector<NumberedSphere>> place_at_random(const Box& box,
                                                           const std::vector<double>& radii,
                                                           double height, std::uint64_t key);

}  // namespace grainsweep
