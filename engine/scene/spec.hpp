// What one packing is: the complete, resolved description of a bed before it exists.
//
// Lengths are in d, the mean diameter of the large grains, or a length among those of a
// distribution; times in sqrt(d / g); masses in the mass of a large grain of mean size; forces in m
// g. See engine/units.hpp.
//
// A specification is plain data. `check` holds every rule about it; nothing else refuses input.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/box.hpp"
#include "engine/scene/size_distribution.hpp"
#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

/// A grain of a bed that comes from elsewhere: centre and radius, d. For a grain that is not a
/// sphere the radius is half its size: the shape as given has radius 1/2.
struct PlacedSphere {
  double x = 0.0, y = 0.0, z = 0.0, radius = 0.5;
};

/// Solid volume per floor area, d: as many grains as fill it up (9.95 is the reference study's).
struct SolidHeight {
  double height = 9.95;
};
/// A number of grains.
struct GrainCount {
  std::int64_t count = 0;
};
/// Grains placed by the user; sizes and start come from them instead of the random generator.
struct PlacedGrains {
  std::vector<PlacedSphere> grains;
  /// How each is turned: unit quaternions x, y, z, w from the shape's frame to the box's. Empty for
  /// spheres.
  std::vector<std::array<double, 4>> orientations = {};
  /// Which component of a mixture each is, from 0; meaningless without one.
  std::vector<std::uint8_t> components = {};
};
using Fill = std::variant<SolidHeight, GrainCount, PlacedGrains>;

/// Sizes: one class or two, each Gaussian, cut at four standard deviations; or, where there is one,
/// a distribution. The diameter of a grain that is no sphere is its scale.
struct SizesSpec {
  double spread = 1.0 / 30.0;  ///< standard deviation of the diameter over its mean, each class
  double small_share = 0.0;    ///< share of the small class in the solid volume, 0..1
  double size_ratio = 0.5;     ///< mean diameter of the small class, d
  std::optional<SizeDistribution> distribution = {};  ///< replaces the classes
};

/// The projected iterations that solve one step. See engine/dynamics/solve.hpp.
enum class Solver {
  projected_gauss_seidel,    ///< "pgs"
  accelerated_gauss_seidel,  ///< "apgs": the same sweeps with Nesterov's momentum
};

/// When a bed counts as settled. See engine/dynamics/settle.hpp.
enum class Rest {
  in_steps,  ///< "in_steps": steps pass every test of rest
  exact,     ///< "exact": after that, all forces balance; spheres only
             ///< (engine/exact/exact_rest.hpp)
};

/// Number type of the solver's rows and velocities; positions are always f64.
enum class Precision { f32, f64 };

/// How grains come down. See engine/dynamics/settle.hpp.
enum class Protocol {
  heavy_ball,  ///< "heavy_ball": damped, in long steps; a descent to rest
  dynamic,     ///< "dynamic": plain contact dynamics, undamped, in steps a quarter as long
};

/// How well a packing is settled: the trade of speed for accuracy, part by part.
/// Its defaults are the preset `balanced`; engine/dynamics/presets.hpp says what each preset
/// promises.
struct Accuracy {
  Protocol protocol = Protocol::heavy_ball;
  Solver solver = Solver::accelerated_gauss_seidel;
  Precision precision = Precision::f32;
  Rest rest = Rest::in_steps;
  double step = 0.2;      ///< dt, sqrt(d/g)
  double momentum = 0.9;  ///< alpha: share of a displacement that damped steps carry on, 0..1
  /// Solver iterations per step of fall, creep and ease, unless fewer solve it; doubled, until they
  /// reach 20,000, while they leave a residual above 0.01 m d.
  int fall_iterations = 400;
  /// How far contacts may stray in a step of the fall because it is not solved better, d: root mean
  /// square, for a step of 0.2 sqrt(d/g), for others in proportion; twice as far for spheres. All
  /// steps of a creep of spheres together may stray 160 times as far as this. Looser solves tap the
  /// bed denser, most in narrow containers, where they may stray less far
  /// (engine/dynamics/stages.hpp, closer_where_narrow).
  double path_tolerance = 2e-4;
  /// Steps after the fall, while the bed creeps to rest, if `step` is 0.2 sqrt(d/g); with shorter
  /// ones more in proportion. Spheres take 1.35 times as many, polyhedra 1.25 times and 60.
  int creep_steps = 480;
  /// The same per step at rest; 1.5 for each mean diameter of height, if that is more; twice as
  /// many for spheres. While they leave more than `residual_tolerance`, up to twice as many in f32,
  /// 16 times as many in f64.
  int rest_iterations = 100;
  double residual_tolerance = 1e-2;   ///< worst residual of the last step at rest, m g
  double kinetic_tolerance = 1e-4;    ///< kinetic energy per grain at rest, m g d
  double contact_tolerance = 0.02;    ///< share of isostatic contacts that may be missing at rest
  double overlap_tolerance = 1e-5;    ///< mean overlap of touching pairs at rest, d
  double imbalance_tolerance = 0.02;  ///< mean static imbalance at rest, in own weights
  double imbalance_gap = 1e-4;        ///< contacts with a smaller gap carry the bed statically, d
  int max_steps = 20000;              ///< a bed that needs more is reported as not settled

  bool operator==(const Accuracy&) const = default;
};

/// Most gap tolerances of one packing.
inline constexpr std::size_t most_gap_tolerances = 8;

/// Largest ratio of two masses of a bed in f32: beyond it the rounding of the forces on a heavy
/// grain, 6e-8 of its weight, comes near the weight of a light one.
inline constexpr double f32_mass_ratio = 1e5;

/// What is measured, and how. Definitions: engine/measure.
struct MeasureSpec {
  double exclude_floor = 3.0;    ///< zone above the floor left out, d
  double exclude_surface = 3.0;  ///< zone below the surface left out, d
  /// A pair touches if its gap is below the tolerance, d. The first one is the headline value.
  std::vector<double> gap_tolerances = {1e-4, 1e-5, 1e-3, 6e-3};
  double bin_width = 0.1;  ///< of profiles, d; at most the width of the box
};

/// A bed whose slab between the zones left out is lower than this is not measured, d.
inline constexpr double least_slab_height = 1.0;

/// What a bed needs for the zones that are left out and such a slab between them, d.
inline double least_height(const MeasureSpec& measure) {
  return measure.exclude_floor + measure.exclude_surface + least_slab_height;
}

struct PackingSpec {
  ShapeSpec shape;  ///< of a grain of size 1; sizes scale it
  Box box;
  Fill fill = SolidHeight{};
  SizesSpec sizes;
  Accuracy accuracy;
  MeasureSpec measure;
  /// Key of every random number of this packing; two packings with equal specs are equal bit by
  /// bit.
  std::uint64_t random_key = 0;
};

/// One broken rule. `path` names the member as the sweep file does, e.g. "box.width"; `message`
/// says what must hold and what was found, e.g. "must be at least 1 (one grain diameter), is 0.5".
struct SpecError {
  std::string path;
  std::string message;
  /// How many times as much as is given the rule asks for, where the message says how much: of many
  /// specifications that break it, the one that asks for most is worth telling.
  double asked = 0.0;
};

/// Every rule that `spec` breaks; empty when it can be packed.
std::vector<SpecError> check(const PackingSpec& spec);

/// Height to which a bed of `spec`, which must be valid, probably settles, d: within a tenth in
/// wide boxes; narrow beds and those of plates come out lower.
double probable_height(const PackingSpec& spec);

/// What to fill in for a bed that is measured, by probable_height with a tenth to spare, as the
/// sweep file names it: "fill.grains 443"; empty for placed grains.
std::string enough_fill(const PackingSpec& spec);

/// Number of grains that `spec` asks for (before any of them is placed).
std::int64_t grain_count(const PackingSpec& spec);

}  // namespace grainsweep
