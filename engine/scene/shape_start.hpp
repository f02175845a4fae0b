// The start of a packing of grains that turn: at random in the air, turned at random, or as placed.
#pragma once

#include <optional>

#include "engine/scene/shape_bed.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Solid fraction of the column in which grains are placed at random.
inline constexpr double shape_start_solid_fraction = 0.4;

/// Radius of the balls that keep centres apart at the start, in radii of the sphere of the grain's
/// volume. Corners of neighbours overlap; the fall parts them by a share of the overlap a step.
inline constexpr double start_ball = 0.7;

/// As many grains of the shape as `spec` asks for, their scales drawn as it draws diameters, a
/// grain of scale s having s^3 times the volume of the shape. Centres by random sequential addition
/// of balls, orientations uniform over all rotations. Numbered from the floor up. Empty if a ball
/// does not fit between the walls or no room is found for it. Placed grains start where and as they
/// are placed.
std::optional<ShapeBed> start_shapes(const PackingSpec& spec);

}  // namespace grainsweep
