#include "engine/cost.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/sleep.hpp"
#include "engine/dynamics/stages.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/size_distribution.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/shape/mixture.hpp"

namespace grainsweep {

namespace {

/// What the sizes of grains are like.
struct SizeMoments {
  double mean_cube = 1.0;            ///< of the diameter, each grain counted once, d^3
  double mean_cube_by_volume = 1.0;  ///< each weighted with its volume, d^3

  /// Mean mass of the grain that a random part of the solids belongs to, over the mean mass of a
  /// grain; 1 if all are alike.
  double unevenness() const { return mean_cube_by_volume / mean_cube; }
};

SizeMoments moments_of(const SizesSpec& sizes) {
  if (sizes.distribution) {
    const SizeCurve curve = curve_of(*sizes.distribution);
    return {mean_cube(curve), mean_cube_by_volume(curve)};
  }
  const double small = std::pow(sizes.size_ratio, 3.0), share = sizes.small_share;
  const double spread = 1.0 + 9.0 * sizes.spread * sizes.spread;
  return {1.0 / (1.0 - share + share / small), (1.0 - share + share * small) * spread};
}

SizeMoments moments_of(const PlacedGrains& placed) {
  double cubes = 0.0, squares = 0.0;
  for (const PlacedSphere& grain : placed.grains) {
    const double cube = std::pow(2.0 * grain.radius, 3.0);
    cubes += cube, squares += cube * cube;
  }
  return {cubes / static_cast<double>(placed.grains.size()), squares / cubes};
}

SizeMoments moments_of(const PackingSpec& spec) {
  const auto* placed = std::get_if<PlacedGrains>(&spec.fill);
  return placed != nullptr ? moments_of(*placed) : moments_of(spec.sizes);
}

/// Whether the creep is shorter than the usual one, as long, or longer.
enum class Creep { loose, usual, strict };
Creep creep_of(const Accuracy& a) {
  const int usual = Accuracy{}.creep_steps;
  return a.creep_steps < usual    ? Creep::loose
         : a.creep_steps == usual ? Creep::usual
                                  : Creep::strict;
}

/// Spheres that differ in size take more rounds to come to rest, in proportion to `unevenness`, up
/// to five times as many. The worst grain of many is worse than that of few.
double unevenness_factor(const PackingSpec& spec, double grains) {
  const double more = std::max(0.0, moments_of(spec).unevenness() - 1.0);
  const double many = std::pow(std::max(1.0, grains / 5000.0), std::min(0.6, 0.6 * more));
  return creep_of(spec.accuracy) == Creep::strict ? std::min(3.0, 1.0 + 0.65 * more) * many
                                                  : std::min(5.0, 1.0 + 0.6 * more) * many;
}

/// What more corners than usual cost.
double corner_factor(const ShapeSpec& shape) {
  constexpr double usual = 20.0;
  return std::pow(std::max(1.0, static_cast<double>(corner_count(shape)) / usual), 0.6);
}

/// Cost of polyhedra, and spheres among them, over that of as many spheres. Flat and long grains
/// have more neighbours in reach, and take more rounds to come to rest.
double shape_factor(const ShapeSpec& shape, Creep creep) {
  if (is_sphere(shape)) return creep == Creep::loose ? 1.4 : 0.5;
  const ShapeExtent extent = extent_of(shape);
  const double slender = extent.circumradius / extent.inradius;
  if (std::holds_alternative<PinacoidSize>(shape)) {
    const double stout = creep == Creep::loose ? 2.2 : creep == Creep::usual ? 1.85 : 1.3;
    return stout * std::pow(std::max(1.0, slender / 2.0), creep == Creep::strict ? 0.3 : 0.6);
  }
  return (creep == Creep::loose ? 3.6 : 2.6) * corner_factor(shape) * std::max(1.0, slender / 5.0);
}

/// The mean over the grains.
double shape_factor(const Mixture& mixture, Creep creep) {
  const std::vector<double> shares = number_shares(mixture);
  double mean = 0.0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    mean += shares[k] * shape_factor(mixture.components[k].shape, creep);
  }
  return mean;
}

/// A polyhedron touches the wall of a tube with each corner by itself.
double tube_factor(const PackingSpec& spec) {
  if (!spec.box.is_tube) return 1.0;
  const bool is_mixture = std::holds_alternative<Mixture>(spec.shape);
  return 1.4 * (is_mixture ? 1.0 : corner_factor(spec.shape));
}

/// The same for all grains of a bed, and for large beds over small ones.
double polyhedron_factor(const PackingSpec& spec, double grains) {
  const double many = std::pow(std::max(1.0, grains / 1000.0), 0.6);
  const Creep creep = creep_of(spec.accuracy);
  const auto* mixture = std::get_if<Mixture>(&spec.shape);
  return many * tube_factor(spec) *
         (mixture != nullptr ? shape_factor(*mixture, creep) : shape_factor(spec.shape, creep));
}

/// How much longer a sweep takes where the rows of a bed of spheres leave the caches.
double memory_factor(double grains) { return std::clamp(std::sqrt(grains / 15000.0), 1.0, 1.45); }

/// Most layers that are awake in a fall, by the solids: those above the depth of sleep and the
/// front.
constexpr double most_layers_awake = 1.5 * sleep_depth;

/// Solver iterations that a path takes, over those of the usual one. In narrow containers
/// a path that is closer for that costs less. A step of the usual fall and creep takes some
/// 23, and none takes more than it may.
double iterations_of_path(const PackingSpec& spec) {
  const double usual = Accuracy{}.path_tolerance, asked = spec.accuracy.path_tolerance;
  const double closer = closer_where_narrow(spec.accuracy, spec.box).path_tolerance;
  constexpr double usual_of_a_step = 23.0;
  const double most = std::max(1.0, spec.accuracy.fall_iterations / usual_of_a_step);
  return std::min(most, std::pow(usual / asked, 0.6) * std::pow(asked / closer, 0.2));
}

/// Solver iterations over all rows that the stages of engine/dynamics/settle.hpp usually need.
/// While a bed fills up its deep part sleeps, so that beyond some height the fall needs no more;
/// the creep of spheres hardly grows with the layers that forces have to find their way through,
/// since inertia grows with depth, and their quench less than in proportion. How long they ease on
/// depends on how calm they must be.
double usual_iterations(const PackingSpec& spec, double layers) {
  const Accuracy& a = spec.accuracy;
  const double falling =
      std::min(layers, most_layers_awake) * std::max(1.0, Accuracy{}.step / a.step);  // in steps
  const double solved = iterations_of_path(spec);
  const double creep =
      std::pow(static_cast<double>(a.creep_steps) / Accuracy{}.creep_steps, 1.4);  // of the usual
  if (!is_sphere(spec.shape)) {
    return solved * (110.0 * falling + 15000.0 * creep) + 80.0 * a.rest_iterations;
  }
  const double fall = (a.protocol == Protocol::dynamic ? 800.0 : 200.0) * falling;
  const double calmer =
      std::max(1.0, Accuracy{}.imbalance_tolerance / std::max(a.imbalance_tolerance, 1e-6));
  return solved * (fall + 15300.0 * std::pow(layers, 0.1) * creep) + 1500.0 * calmer * calmer +
         30.0 * a.rest_iterations * std::pow(std::max(1.0, layers / 10.0), 0.8);
}

/// Rounds of creep and rest that high beds of spheres take over those of low ones: few iterations
/// hardly reach through many layers of a box, and many layers of many grains take more of them,
/// too, but at `balanced` no more than are awake in the fall, where they have slid on.
double rounds_factor(const PackingSpec& spec, double grains, double layers) {
  const Creep creep = creep_of(spec.accuracy);
  if (creep == Creep::loose && !spec.box.is_tube) {
    return std::pow(std::max(1.0, layers / 40.0), 0.25);
  }
  constexpr double many = 6e5;  // grains times layers
  const bool counts_all = creep == Creep::strict || spec.box.is_tube;
  const double counted = counts_all ? layers : std::min(layers, most_layers_awake);
  return std::pow(std::max(1.0, grains * counted / many), 0.7);
}

/// Spheres one above the other in a tube lean on its wall from side to side; where each comes near
/// the next but one, D = 1.67 to 1.9 d, high beds of unequal spheres slide on for many rounds
/// before they rest.
double leaning_factor(const PackingSpec& spec, double grains) {
  const double diameter = spec.box.width;
  if (!spec.box.is_tube || diameter <= 1.67 || diameter >= 1.9) return 1.0;
  if (moments_of(spec).unevenness() <= 1.0) return 1.0;
  constexpr double few = 150.0;
  switch (creep_of(spec.accuracy)) {
    case Creep::loose:
      return std::max(1.0, 1.3 * std::pow(grains / few, 1.6));
    case Creep::usual:
      return std::max(1.0, 1.4 * grains / few);
    case Creep::strict:
      return 1.0;
  }
  return 1.0;
}

/// Grains in the smallest of the sections through the middle of a bed along its axes.
double smallest_section(const Box& box, double grains, double solid_volume) {
  const double height = usual_height(box, solid_volume), volume = box.floor_area() * height;
  const double section = volume / std::max({box.length, box.width, height});
  return section / std::pow(volume / grains, 2.0 / 3.0);
}

/// Seconds of the search for exact rest: rounds, more of them in larger beds, each of which factors
/// the bed's stiffness; this takes longer the larger the sections are that cut the bed.
double exact_seconds(const PackingSpec& spec, double grains, double solid_volume) {
  if (spec.accuracy.rest != Rest::exact) return 0.0;
  constexpr double section_of_bed = 85.0;  // of 2000 grains at W = 5 d
  const double section = smallest_section(spec.box, grains, solid_volume);
  return 1.1e-8 * std::pow(grains, 2.6) * std::pow(section / section_of_bed, 1.5);
}

/// Bytes of the factors of a bed's stiffness: 0.4 to 1.2 times that of beds of 2000 to 4000 grains.
double exact_bytes(const PackingSpec& spec, double grains, double solid_volume) {
  if (spec.accuracy.rest != Rest::exact) return 0.0;
  const double section = smallest_section(spec.box, grains, solid_volume);
  return 1300.0 * grains * std::cbrt(grains * section);
}

/// Pairs listed in a fall for each sphere, by what engine/dynamics/stages.cpp calls near and
/// engine/rows/sphere_contacts.cpp adds: those within reach in a bed of solid fraction 0.6.
double listed_pairs(double diameter) {
  const double reach = 0.1 + 0.09 * std::min(1.0, 4.0 * diameter);
  return 0.5 * 0.6 * 8.0 * std::pow(1.0 + reach / diameter, 3.0);
}

double bytes_of_grain(const PackingSpec& spec, double grains) {
  const double number_size = spec.accuracy.precision == Precision::f32 ? 1.0 : 1.3;
  if (!is_sphere(spec.shape)) return 11000.0 * number_size;
  const double pairs = listed_pairs(std::cbrt(moments_of(spec).mean_cube));
  return number_size * (2000.0 + 95.0 * std::min(pairs, grains / 2.0));
}

}  // namespace

// An iteration costs 2.05 ns a row, of which a bed of spheres has about four per grain, more where
// the bed leaves the caches; with its share of the narrow phase it costs 52 ns a grain that turns.
// Measured on servers of 2.4 to 2.6 GHz: with AVX-512 spheres take 0.65 to 1.1 times that, without
// it 1.3 times, grains that turn 0.85 to 1.1 and 1.1 times.
Cost estimate_cost(const PackingSpec& spec) {
  const auto grains = static_cast<double>(grain_count(spec));
  const double cubes = grains * moments_of(spec).mean_cube;
  const double layers = cubes / spec.box.floor_area() + 1.0;
  const double number_size = spec.accuracy.precision == Precision::f32 ? 1.0 : 1.7;
  const bool turn = !is_sphere(spec.shape);
  const double seconds = turn ? 52e-9 : 4.0 * 2.05e-9;
  const double factor = turn ? polyhedron_factor(spec, grains)
                             : unevenness_factor(spec, grains) * memory_factor(grains) *
                                   rounds_factor(spec, grains, layers) *
                                   leaning_factor(spec, grains);
  return {
      grains * number_size * factor * usual_iterations(spec, layers) * seconds +
          exact_seconds(spec, grains, pi / 6.0 * cubes),
      8e6 + grains * bytes_of_grain(spec, grains) + exact_bytes(spec, grains, pi / 6.0 * cubes)};
}

}  // namespace grainsweep
