#include "engine/scene/sizes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/scene/random.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

/// Expected volume of a grain of Gaussian diameter, in grains of diameter 1: E[D^3] = mean^3 (1 + 3
/// spread^2).
double expected_volume(double diameter, double spread) {
  return diameter * diameter * diameter * (1.0 + 3.0 * spread * spread);
}

/// Rounded to the nearest; numbers that are far too large become a large one.
std::int64_t rounded(double count) { return std::llround(std::min(count, 1e17)); }

/// `volume` in grains of diameter 1.
ClassCounts counts_for_volume(double volume, const SizesSpec& sizes) {
  const double small_volume = volume * sizes.small_share;
  return {rounded((volume - small_volume) / expected_volume(1.0, sizes.spread)),
          rounded(small_volume / expected_volume(sizes.size_ratio, sizes.spread))};
}

/// Splits a number of grains so that the small ones hold their share of the volume.
ClassCounts counts_for_grains(std::int64_t grains, const SizesSpec& sizes) {
  const double ratio = sizes.size_ratio * sizes.size_ratio * sizes.size_ratio;
  const double small_parts = sizes.small_share / ratio;
  const double large_parts = 1.0 - sizes.small_share;
  const std::int64_t small =
      std::llround(static_cast<double>(grains) * small_parts / (small_parts + large_parts));
  return {grains - small, small};
}

double draw_radius(std::uint64_t key, std::uint64_t grain, double diameter, double spread) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const auto words = random_words(key, Purpose::size, grain, attempt);
    const double deviation = standard_normal(words[0], words[1]);
    if (std::abs(deviation) <= largest_deviation) {
      return diameter / 2.0 * (1.0 + spread * deviation);
    }
  }
}

/// Draws small grains until their volume is as near to `wanted` as whole grains can come.
void add_small_volume(const PackingSpec& spec, double wanted, std::vector<double>& radii) {
  for (double volume = 0.0;;) {
    const double radius =
        draw_radius(spec.random_key, radii.size(), spec.sizes.size_ratio, spec.sizes.spread);
    if (volume + sphere_volume(radius) / 2.0 > wanted) {
      return;
    }
    volume += sphere_volume(radius);
    radii.push_back(radius);
  }
}

/// How many grains of size 1 fill the solid height of `spec`.
double grains_of_size_one(const PackingSpec& spec) {
  const double height = std::get<SolidHeight>(spec.fill).height;
  return height * spec.box.floor_area() / extent_of(spec.shape).volume;
}

/// The volume of small grains nearest to `wanted`, which keeps their share exact, that the height
/// to be filled allows: where large grains are few, one more or less is much of it. Where small
/// grains are the lesser part, their share goes before the height, but for a tenth.
double small_volume(const PackingSpec& spec, double wanted, double large_volume) {
  constexpr double of_height = 0.02, of_wanted = 0.1;
  const double whole = grains_of_size_one(spec) * sphere_volume(0.5);
  const double near_height = std::clamp(wanted, (1.0 - of_height) * whole - large_volume,
                                        (1.0 + of_height) * whole - large_volume);
  if (wanted >= large_volume) return near_height;
  return std::clamp(near_height, (1.0 - of_wanted) * wanted, (1.0 + of_wanted) * wanted);
}

/// Volume of all grains of a file, d^3.
double placed_volume(const PlacedGrains& placed, const ShapeSpec& shape) {
  std::vector<double> of_shape;
  const auto* mixture = std::get_if<Mixture>(&shape);
  if (mixture == nullptr) {
    of_shape = {extent_of(shape).volume};
  } else {
    for (const MixtureComponent& one : mixture->components) {
      of_shape.push_back(extent_of(one.shape).volume);
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const double size = 2.0 * placed.grains[i].radius;
    sum += size * size * size * of_shape[mixture != nullptr ? placed.components[i] : 0];
  }
  return sum;
}

std::vector<double> drawn_radii(const SizeCurve& curve, std::int64_t count, std::uint64_t key) {
  std::vector<double> radii = draw_diameters(curve, count, key);
  for (double& radius : radii) radius /= 2.0;
  return radii;
}

}  // namespace

ClassCounts class_counts(const PackingSpec& spec) {
  const auto& distribution = spec.sizes.distribution;
  if (std::holds_alternative<SolidHeight>(spec.fill)) {
    const double volume = grains_of_size_one(spec);
    if (distribution) return {rounded(volume / mean_cube(curve_of(*distribution))), 0};
    return counts_for_volume(volume, spec.sizes);
  }
  if (distribution) return {std::get<GrainCount>(spec.fill).count, 0};
  return counts_for_grains(std::get<GrainCount>(spec.fill).count, spec.sizes);
}

double solid_height(const PackingSpec& spec) {
  if (const auto* fill = std::get_if<SolidHeight>(&spec.fill)) return fill->height;
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return placed_volume(*placed, spec.shape) / spec.box.floor_area();
  }
  const ClassCounts counts = class_counts(spec);
  const SizesSpec& sizes = spec.sizes;
  const double large = sizes.distribution ? mean_cube(curve_of(*sizes.distribution))
                                          : expected_volume(1.0, sizes.spread);
  const double grains =
      static_cast<double>(counts.large) * large +
      static_cast<double>(counts.small) * expected_volume(sizes.size_ratio, sizes.spread);
  return grains * extent_of(spec.shape).volume / spec.box.floor_area();
}

std::vector<double> draw_radii(const PackingSpec& spec) {
  const ClassCounts counts = class_counts(spec);
  if (spec.sizes.distribution) {
    return drawn_radii(curve_of(*spec.sizes.distribution), counts.large, spec.random_key);
  }
  std::vector<double> radii;
  double large_volume = 0.0;
  for (std::int64_t i = 0; i < counts.large; ++i) {
    radii.push_back(draw_radius(spec.random_key, radii.size(), 1.0, spec.sizes.spread));
    large_volume += sphere_volume(radii.back());
  }
  const double share = spec.sizes.small_share;
  if (std::holds_alternative<SolidHeight>(spec.fill) && counts.large > 0 && share > 0.0) {
    add_small_volume(spec, small_volume(spec, share / (1.0 - share) * large_volume, large_volume),
                     radii);
    return radii;
  }
  for (std::int64_t i = 0; i < counts.small; ++i) {
    radii.push_back(
        draw_radius(spec.random_key, radii.size(), spec.sizes.size_ratio, spec.sizes.spread));
  }
  return radii;
}

double small_class_limit(const SizesSpec& sizes) {
  if (sizes.small_share <= 0.0 || sizes.distribution) {
    return 0.0;
  }
  return sizes.small_share < 1.0 ? sizes.size_ratio / (1.0 + sizes.size_ratio) : infinity;
}

}  // namespace grainsweep
