// Mixtures of shapes: what is wrong with one, and how many of its grains have which shape.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/shape/convex_shape.hpp"
#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

/// What forbids a mixture, the number of the component first, from 1; "" if nothing does.
std::string problem_with(const Mixture& mixture);

/// The convex shapes of a spec that is not a sphere: one, or those of the components of a mixture.
/// Requires a shape that nothing forbids.
std::vector<ConvexShape> shapes_of(const ShapeSpec& spec);

/// Share of the grains that each component has, adding up to 1: its share divided by the
/// component's volume (then normalised), where shares are by volume. Requires a mixture that
/// nothing forbids.
std::vector<double> number_shares(const Mixture& mixture);

/// Grains of each component, by the largest remainder: every number is within one of its share of
/// `grains`, and they add up to `grains`. `shares` must add up to 1. Of equal remainders the first
/// goes first.
std::vector<std::int64_t> component_counts(const std::vector<double>& shares, std::int64_t grains);

}  // namespace grainsweep
