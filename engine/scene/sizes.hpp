// Grain sizes: one or two Gaussian classes, cut at four standard deviations, or a distribution.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/spec.hpp"

namespace grainsweep {

/// Largest deviation of a diameter from its class's mean, in standard deviations; the one grain in
/// 16,000 beyond it is drawn again.
inline constexpr double largest_deviation = 4.0;

/// Grains of each class.
struct ClassCounts {
  std::int64_t large = 0;
  std::int64_t small = 0;
};

/// How many grains of each class the fill asks for, by the expected volume of a grain; those of a
/// distribution are all of the large class. Not for placed grains, which bring their own sizes.
ClassCounts class_counts(const PackingSpec& spec);

/// Radius of every grain, d, the large class first; of a distribution, the largest grain first.
/// Same key, same radii. A fill by solid height with both classes gets the number of small grains
/// that brings their share of the drawn volume nearest to the requested one, within half a small
/// grain unless that would put the bed more than 2 % off its height; it may be a few more or less
/// than class_counts expects.
std::vector<double> draw_radii(const PackingSpec& spec);

/// Radius below which a grain counts as small, d: as many standard deviations from the mean of one
/// class as from that of the other, 2 q / (1 + q) in diameters for a size ratio q. 0 where there is
/// no small class, infinite where there is no large one. Classes whose means are less than eight
/// standard deviations apart overlap there. A distribution has no small class.
double small_class_limit(const SizesSpec& sizes);

/// Solid volume per floor area that `spec` asks for, d.
double solid_height(const PackingSpec& spec);

}  // namespace grainsweep
