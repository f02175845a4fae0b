#include "engine/scene/spec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "engine/interval.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/shape/mixture.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {
namespace {

using Errors = std::vector<SpecError>;

constexpr double shortest_side = 1.0;            // d; of a large grain
constexpr double longest_side = 10'000.0;        // d; cell indices stay far below 32 bits
constexpr std::int64_t max_grains = 10'000'000;  // grain indices are 32 bits wide
constexpr double settled_wall_overlap = 0.01;    // d; far above that of any settled bed
constexpr double finest_bin = 0.01;              // d; finer bins hold noise and fill the disk
// Steps solved to rounding stray by about this in f64, and by more in f32, d.
constexpr double least_path_tolerance = 1e-9;
constexpr double image_margin = 0.2;  // d; candidates never reach farther than this
constexpr const char* missing_diameter =
    "; radii reach more than 1 d: fill.diameter, the length in the file that is d, is missing or "
    "wrong";

constexpr double tiny_in_file = 0.2;  // d
constexpr const char* wrong_diameter =
    "; the largest grain of the file is less than 0.2 d across: fill.diameter, the length in the "
    "file that is d, is wrong";

bool require_in(const Interval& interval, double value, const char* path, Errors& errors) {
  if (interval.holds(value)) return true;
  errors.push_back({path, "must lie in " + interval.text() + ", is " + bound_text(value)});
  return false;
}

/// Of a number that people know in percent, too.
bool require_share(const Interval& interval, double value, const char* path, Errors& errors) {
  if (require_in(interval, value, path, errors)) return true;
  errors.back().message += percent_hint(interval, value);
  return false;
}

double largest_radius(const PlacedGrains& placed) {
  double radius = 0.0;
  for (const PlacedSphere& grain : placed.grains) radius = std::max(radius, grain.radius);
  return radius;
}

/// Extents of the components of a mixture at size 1, in their order; nothing of other shapes.
std::vector<ShapeExtent> component_extents(const ShapeSpec& shape) {
  std::vector<ShapeExtent> extents;
  if (const auto* mixture = std::get_if<Mixture>(&shape)) {
    for (const MixtureComponent& one : mixture->components) {
      extents.push_back(extent_of(one.shape));
    }
  }
  return extents;
}

/// The extent of one placed grain at size 1: of its component, whatever the share of that is.
/// `shape` where the file names none that there is.
const ShapeExtent& extent_of_placed(const PlacedGrains& placed, std::size_t i,
                                    const std::vector<ShapeExtent>& components,
                                    const ShapeExtent& shape) {
  const bool is_named = i < placed.components.size() && placed.components[i] < components.size();
  return is_named ? components[placed.components[i]] : shape;
}

/// Placed grains of one component, d across.
struct PlacedExtents {
  double largest = 0.0, total = 0.0;
  std::size_t grains = 0;
};

/// By component; all in one where the grains are of one shape.
std::map<int, PlacedExtents> placed_extents(const PlacedGrains& placed, const ShapeSpec& spec,
                                            const ShapeExtent& shape) {
  const std::vector<ShapeExtent> components = component_extents(spec);
  std::map<int, PlacedExtents> extents;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const double size = 2.0 * placed.grains[i].radius;
    const double across = 2.0 * extent_of_placed(placed, i, components, shape).circumradius * size;
    PlacedExtents& of_one = extents[i < placed.components.size() ? placed.components[i] : 0];
    of_one.largest = std::max(of_one.largest, across);
    of_one.total += across;
    ++of_one.grains;
  }
  return extents;
}

/// The largest placed grain, d across.
double largest_placed(const PlacedGrains& placed, const ShapeSpec& spec, const ShapeExtent& shape) {
  double largest = 0.0;
  for (const auto& [component, one] : placed_extents(placed, spec, shape)) {
    largest = std::max(largest, one.largest);
  }
  return largest;
}

/// Largest size that can occur.
double largest_size(const PackingSpec& spec) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return 2.0 * largest_radius(*placed);
  }
  if (spec.sizes.distribution) return curve_of(*spec.sizes.distribution).diameters.back();
  const double mean = spec.sizes.small_share < 1.0 ? 1.0 : spec.sizes.size_ratio;
  return mean * (1.0 + largest_deviation * spec.sizes.spread);
}

/// The largest grain that can occur, d across.
double largest_grain(const PackingSpec& spec, const ShapeExtent& shape) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return largest_placed(*placed, spec.shape, shape);
  }
  return 2.0 * shape.circumradius * largest_size(spec);
}

/// Mean extent of the large grains, or that of the largest one, which decides how high and how
/// loose a bed is, d.
double outcome_extent(const PackingSpec& spec, const ShapeExtent& shape) {
  const SizesSpec& sizes = spec.sizes;
  if (sizes.distribution || std::holds_alternative<PlacedGrains>(spec.fill)) {
    return largest_grain(spec, shape);
  }
  return 2.0 * shape.circumradius * (sizes.small_share < 1.0 ? 1.0 : sizes.size_ratio);
}

/// The shape's extent; nothing if the shape is forbidden.
std::optional<ShapeExtent> check_shape(const ShapeSpec& spec, Errors& errors) {
  if (is_sphere(spec)) return extent_of(spec);
  if (const auto* mixture = std::get_if<Mixture>(&spec)) {
    const std::string problem = problem_with(*mixture);
    if (problem.empty()) return extent_of(spec);
    errors.push_back({"shape.mixture", problem});
    return std::nullopt;
  }
  const Hull hull = shape_of(spec);
  if (hull.shape) return extent_of(*hull.shape);
  errors.push_back({"shape." + std::string(name_of(spec)), hull.error});
  return std::nullopt;
}

bool check_sizes(const SizesSpec& sizes, Errors& errors) {
  if (sizes.distribution) {
    const std::string fault = fault_of(*sizes.distribution);
    if (!fault.empty()) errors.push_back({"sizes.distribution", fault});
    return fault.empty();
  }
  const bool spread = require_share({0.0, 0.2}, sizes.spread, "sizes.spread", errors);
  const bool share = require_share({0.0, 1.0}, sizes.small_share, "sizes.small_share", errors);
  const bool ratio =
      require_in({0.02, 1.0, true, false}, sizes.size_ratio, "sizes.size_ratio", errors);
  return spread && share && ratio;
}

/// One horizontal side. Walls must hold the largest grain; a periodic side must be so long that no
/// grain meets two images of the same neighbour, or its own.
bool check_side(const char* path, double side, Boundary boundary, double largest, bool is_tube,
                Errors& errors) {
  const bool walls = boundary == Boundary::walls;
  const double needed = std::max(shortest_side, walls ? largest : 2.0 * (largest + image_margin));
  if (side >= needed && side <= longest_side) return true;
  std::string reason;
  if (!walls && needed > shortest_side)
    reason = " (periodic: twice the largest grain and a margin)";
  if (walls && needed > shortest_side) {
    reason = is_tube ? " (the largest grain in a tube)" : " (the largest grain between two walls)";
  }
  const bool is_in_metres = side > 0.0 && side < 0.2;
  const std::string unit = is_in_metres ? "; lengths are in d, a large grain's mean diameter" : "";
  errors.push_back({path,
                    "must lie in [" + least_text(needed) + ", " + bound_text(longest_side) + "]" +
                        reason + ", is " + bound_text(side) + unit,
                    side > 0.0 ? needed / side : 0.0});
  return false;
}

/// Grains that no container has room for are wrong, not the container. `across`: of one of size 1.
bool check_room(const PackingSpec& spec, double across, double largest, Errors& errors) {
  if (largest <= longest_side / 2.0 - image_margin) return true;
  const bool is_placed = std::holds_alternative<PlacedGrains>(spec.fill);
  const std::string path = is_placed                   ? "fill.file"
                           : across > largest / across ? "shape." + std::string(name_of(spec.shape))
                                                       : "sizes";
  errors.push_back(
      {path,
       "gives grains of " + number_text(largest) + " d across, and containers are at most " +
           bound_text(longest_side) + " d long" +
           (is_placed ? missing_diameter : "; lengths are in d, a large grain's mean diameter")});
  return false;
}

bool check_box(const Box& box, double largest, Errors& errors) {
  if (box.is_tube) {
    if (box.width != box.length || !is_walled_around(box)) {
      errors.push_back({"tube.diameter",
                        "must be both the length and the width of the tube's box, "
                        "which has walls on all sides"});
      return false;
    }
    return check_side("tube.diameter", box.length, Boundary::walls, largest, true, errors);
  }
  const bool length = check_side("box.length", box.length, box.x, largest, false, errors);
  const bool width = check_side("box.width", box.width, box.y, largest, false, errors);
  return length && width;
}

void require_count(std::int64_t count, const char* path, Errors& errors) {
  if (count >= 1 && count <= max_grains) return;
  errors.push_back({path, "must give 1 to " + std::to_string(max_grains) + " grains, gives " +
                              bound_text(static_cast<double>(count))});
}

bool is_outside(double centre, double radius, double side, Boundary boundary) {
  const double reach = boundary == Boundary::walls ? radius - settled_wall_overlap : 0.0;
  return !(centre >= reach && centre <= side - reach);
}

/// Of a tube.
bool is_outside(const PlacedSphere& grain, double radius, const Box& box) {
  const double x = grain.x - box.length / 2.0, y = grain.y - box.width / 2.0;
  const double reach = box.length / 2.0 - radius + settled_wall_overlap;
  return !(reach >= 0.0 && x * x + y * y <= reach * reach);
}

/// What is wrong with one placed grain; empty if nothing is. A ball of `inner` times its size lies
/// within it.
std::string fault_of(const PlacedSphere& grain, double inner, const Box& box) {
  const double within = 2.0 * inner * grain.radius;
  if (!(grain.radius > 0.0 && grain.radius <= longest_side)) {
    return "the radius must be positive and at most " + bound_text(longest_side) + ", is " +
           bound_text(grain.radius);
  }
  if (box.is_tube && is_outside(grain, within, box)) {
    return "lies outside the tube, whose axis stands at x = y = " + bound_text(box.length / 2.0) +
           ": x = " + bound_text(grain.x) + ", y = " + bound_text(grain.y) + ", radius " +
           bound_text(grain.radius) + ", tube.diameter " + bound_text(box.length);
  }
  if (is_outside(grain.x, within, box.length, box.x)) {
    return "lies outside the box: x = " + bound_text(grain.x) + ", radius " +
           bound_text(grain.radius) + ", box.length " + bound_text(box.length);
  }
  if (is_outside(grain.y, within, box.width, box.y)) {
    return "lies outside the box: y = " + bound_text(grain.y) + ", radius " +
           bound_text(grain.radius) + ", box.width " + bound_text(box.width);
  }
  if (!(grain.z >= within - settled_wall_overlap && grain.z <= longest_side)) {
    return "lies below the floor or too high: z = " + bound_text(grain.z) + ", radius " +
           bound_text(grain.radius);
  }
  return "";
}

/// A quaternion may have been rounded to single precision.
std::string fault_of(const std::array<double, 4>& q) {
  constexpr double rounding = 1e-5;
  const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (std::abs(squared - 1.0) <= rounding) return "";
  return "qx, qy, qz, qw must be a unit quaternion; their squares add up to " + bound_text(squared);
}

/// Spheres have no orientation, all others need one each.
void check_orientations(const PlacedGrains& placed, bool are_spheres, Errors& errors) {
  if (are_spheres) {
    if (placed.orientations.empty()) return;
    errors.push_back({"fill.file", "spheres have no orientation; leave qx, qy, qz, qw out"});
  } else if (placed.orientations.size() != placed.grains.size()) {
    errors.push_back({"fill.file",
                      "non-spherical grains need an orientation each: give the "
                      "columns qx, qy, qz, qw"});
  }
}

/// The first bad grain speaks for all of them: a wrong unit spoils every line.
void check_placed(const PackingSpec& spec, const PlacedGrains& placed, const ShapeExtent& shape,
                  Errors& errors) {
  const std::vector<ShapeExtent> components = component_extents(spec.shape);
  std::string first;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const double inner = extent_of_placed(placed, i, components, shape).inradius;
    std::string fault = fault_of(placed.grains[i], inner, spec.box);
    if (fault.empty() && i < placed.orientations.size()) fault = fault_of(placed.orientations[i]);
    if (fault.empty()) continue;
    if (++bad == 1) first = "grain " + std::to_string(i + 1) + " " + fault;
  }
  if (bad == 0) return;
  const std::string more = bad == 1 ? "" : "; " + std::to_string(bad) + " grains are wrong in all";
  const bool are_large = largest_radius(placed) > 1.0;
  errors.push_back({"fill.file", first + more + (are_large ? missing_diameter : "")});
}

/// Every grain of a mixture is of one of its components; the first that is not speaks for all.
void check_components(const PlacedGrains& placed, const Mixture& mixture, Errors& errors) {
  const std::string wanted =
      "the column component must hold the number of each grain's component "
      "in shape.mixture, 1 to " +
      std::to_string(mixture.components.size());
  if (placed.components.size() != placed.grains.size()) {
    errors.push_back({"fill.file", "does not say which grain is of which component: " + wanted});
    return;
  }
  const auto bad =
      std::find_if(placed.components.begin(), placed.components.end(),
                   [&](std::uint8_t component) { return component >= mixture.components.size(); });
  if (bad == placed.components.end()) return;
  errors.push_back({"fill.file", "grain " + std::to_string(bad - placed.components.begin() + 1) +
                                     " is of no component: " + wanted});
}

bool has_hull(const ShapeSpec& shape) {
  if (const auto* mixture = std::get_if<Mixture>(&shape)) {
    return std::any_of(mixture->components.begin(), mixture->components.end(),
                       [](const MixtureComponent& one) { return has_hull(one.shape); });
  }
  return std::holds_alternative<HullVertices>(shape);
}

/// Whether grains are so small that it is their shape that is wrong where too many fill the box.
bool is_tiny(const ShapeExtent& shape) {
  constexpr double tiny = 0.2;  // d across
  return 2.0 * shape.circumradius < tiny;
}

void check_fill(const PackingSpec& spec, const std::optional<ShapeExtent>& shape,
                bool counts_are_defined, Errors& errors) {
  if (const auto* solid = std::get_if<SolidHeight>(&spec.fill)) {
    const bool height =
        require_in({0.0, 1000.0, true, false}, solid->height, "fill.solid_height", errors);
    if (!height || !counts_are_defined) return;
    const std::int64_t count = grain_count(spec);
    if (count > max_grains && is_tiny(*shape) && !has_hull(spec.shape)) {
      errors.push_back({"shape." + std::string(name_of(spec.shape)),
                        joined("gives grains of ", number_text(2.0 * shape->circumradius),
                               " d across, ", count, " of them, and at most ", max_grains,
                               " are packed; lengths are in d, a large grain's mean diameter")});
      return;
    }
    require_count(count, "fill.solid_height", errors);
  } else if (const auto* grains = std::get_if<GrainCount>(&spec.fill)) {
    require_count(grains->count, "fill.grains", errors);
  } else {
    const auto& placed = std::get<PlacedGrains>(spec.fill);
    require_count(grain_count(spec), "fill.file", errors);
    if (shape) check_placed(spec, placed, *shape, errors);
    check_orientations(placed, is_sphere(spec.shape), errors);
    if (const auto* mixture = std::get_if<Mixture>(&spec.shape)) {
      check_components(placed, *mixture, errors);
    }
  }
}

/// For wide beds. The longer or flatter grains are, the looser they lie: needles 1:0.05:0.05 come
/// down to 0.20.
double loosest_of_shape(const ShapeSpec& shape) {
  constexpr double stout = 6.0;  // outer over inner radius
  if (is_sphere(shape)) return 0.5;
  const ShapeExtent extent = extent_of(shape);
  return 0.4 * std::min(1.0, std::pow(stout * extent.inradius / extent.circumradius, 0.8));
}

/// Solid fraction that beds never stay below. Between walls nearer than two grains layers do not
/// interlock: spheres come down to 0.45 between walls, to 0.33 in a shaft and to 0.32 in a tube.
double loosest_solid_fraction(const PackingSpec& spec, double across) {
  double fraction = loosest_of_shape(spec.shape);
  const Box& box = spec.box;
  if (box.is_tube) return box.length < 2.5 * across ? 0.6 * fraction : fraction;
  if (box.x == Boundary::walls && box.length < 2.0 * across) fraction *= 0.65;
  if (box.y == Boundary::walls && box.width < 2.0 * across) fraction *= 0.65;
  return fraction;
}

/// Solid fraction of most beds, over the loosest: spheres come to 0.6 beside walls, stout polyhedra
/// to 0.62, needles 1:0.1:0.1 to 0.41.
double usual_solid_fraction(const PackingSpec& spec, double across) {
  const double denser = is_sphere(spec.shape) ? 1.2 : 1.55;
  return denser * loosest_solid_fraction(spec, across);
}

/// The larger zone first: that is the one to make smaller.
std::string left_out_text(const MeasureSpec& measure) {
  return measure.exclude_surface > measure.exclude_floor
             ? "measure.exclude_surface, measure.exclude_floor"
             : "measure.exclude_floor, measure.exclude_surface";
}

/// How many times the fill makes a bed that is measured, by probable_height with a tenth to spare.
double enough_over_given(const PackingSpec& spec) {
  return 1.1 * least_height(spec.measure) / probable_height(spec);
}

/// Refuses a bed that must come out too low to be measured. Its highest grains stand out by one
/// diameter.
void check_height(const PackingSpec& spec, double across, Errors& errors) {
  const auto* placed = std::get_if<PlacedGrains>(&spec.fill);
  const double highest = solid_height(spec) / loosest_solid_fraction(spec, across) + across;
  const double needed = least_height(spec.measure);
  if (highest >= needed) return;
  const bool is_usual = needed <= least_height(MeasureSpec());
  const bool is_counted = std::holds_alternative<GrainCount>(spec.fill);
  errors.push_back({!is_usual    ? "measure"
                    : is_counted ? "fill.grains"
                    : placed     ? "fill.file"
                                 : "fill.solid_height",
                    "gives a bed too low to be measured: at most " + number_text(highest) +
                        " d high, and " + left_out_text(spec.measure) + " and a slab of " +
                        bound_text(least_slab_height) + " d between them take " +
                        number_text(needed) + " d" +
                        (placed ? wrong_diameter
                                : "; give " + enough_fill(spec) + " or more, or leave less out"),
                    placed ? 0.0 : enough_over_given(spec)});
}

/// How far the highest grain falls at least, d, where a start may be as dense as the loosest beds.
constexpr double least_drop = 0.1;

/// Steps in which the highest grain cannot even reach the bed: none falls faster than freely, or,
/// damped, faster than its momentum lets it. If they would be too few at the usual accuracy as
/// well, the fill is to blame.
void check_fall(const PackingSpec& spec, double across, Errors& errors) {
  const double start =
      is_sphere(spec.shape) ? sphere_start_solid_fraction : polyhedron_start_solid_fraction;
  const double loosest = loosest_solid_fraction(spec, across);
  const double solid = solid_height(spec);
  const double drop = std::max(least_drop, solid * (1.0 / start - 1.0 / loosest));
  const auto steps_of = [&](const Accuracy& a) {
    const bool is_damped = a.protocol == Protocol::heavy_ball;
    const double free_fall = std::sqrt(2.0 * drop) / a.step;
    const double damped = is_damped ? drop * (1.0 - a.momentum) / (a.step * a.step) : 0.0;
    return std::ceil(std::max(free_fall, damped));
  };
  const Accuracy& a = spec.accuracy;
  const Accuracy usual;
  if (steps_of(a) <= a.max_steps) return;
  const std::string fall = "in steps of " + number_text(a.step) + " the fall alone takes " +
                           number_text(steps_of(a)) + " of them, max_steps is " +
                           std::to_string(a.max_steps);
  if (steps_of(usual) <= usual.max_steps) {
    errors.push_back({"accuracy", "cannot come to rest: " + fall});
    return;
  }
  const bool is_counted = std::holds_alternative<GrainCount>(spec.fill);
  errors.push_back({is_counted ? "fill.grains" : "fill.solid_height",
                    "gives a bed too high to come to rest, " + number_text(solid) +
                        " d of solid: " + fall + "; fill in less, or widen the box"});
}

/// Checks what follows from the parts together, once each of them is valid. A few grains of a file
/// may be packed to be exported alone.
void check_outcome(const PackingSpec& spec, const ShapeExtent& shape, Errors& errors) {
  const double across = outcome_extent(spec, shape);
  if (std::holds_alternative<PlacedGrains>(spec.fill)) {
    if (across < tiny_in_file) check_height(spec, across, errors);
    return;
  }
  check_height(spec, across, errors);
  check_fall(spec, across, errors);
}

/// A hull far larger or smaller than d has the wrong unit: what to say of it, as `owner`, whose
/// size is `size`; "" if it has not.
std::string hint_at_hull(const ShapeSpec& shape, const std::string& owner,
                         const std::string& size) {
  if (!std::holds_alternative<HullVertices>(shape)) return "";
  const double across = 2.0 * extent_of(shape).circumradius;
  if (across > 0.2 && across < 5.0) return "";
  return "; " + owner + " is " + number_text(across) + " d across: " + size +
         ", the length in its vertices that is d, is missing or wrong";
}

/// Says of hulls in the wrong unit that they are, whatever other errors follow from that. The shape
/// must be allowed.
void hint_at_size(const ShapeSpec& shape, Errors& errors) {
  std::string hint = hint_at_hull(shape, "the shape", "shape.hull.size");
  if (const auto* mixture = std::get_if<Mixture>(&shape)) {
    for (std::size_t k = 0; k < mixture->components.size(); ++k) {
      const std::string number = std::to_string(k + 1);
      hint += hint_at_hull(mixture->components[k].shape, "component " + number + " of the mixture",
                           "its hull.size");
    }
  }
  for (SpecError& error : errors) {
    const bool is_of_size = error.path.starts_with("box.") || error.path.starts_with("fill.") ||
                            error.path.starts_with("shape.") || error.path.starts_with("tube.");
    if (is_of_size) error.message += hint;
  }
}

void check_accuracy(const Accuracy& accuracy, Errors& errors) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto positive = [&](double value, const char* path) {
    if (value > 0.0 && value <= most) return;
    errors.push_back({path, "must be positive, is " + bound_text(value)});
  };
  // In shorter steps a grain at rest moves by less than f32 resolves of its place.
  require_in({1e-4, 2.0}, accuracy.step, "accuracy.step", errors);
  require_in({0.0, 1.0, false, true}, accuracy.momentum, "accuracy.momentum", errors);
  require_in({1.0, 1e6}, accuracy.fall_iterations, "accuracy.fall_iterations", errors);
  if (!(accuracy.path_tolerance >= least_path_tolerance && accuracy.path_tolerance <= most)) {
    errors.push_back({"accuracy.path_tolerance", "must be at least " +
                                                     bound_text(least_path_tolerance) + ", is " +
                                                     bound_text(accuracy.path_tolerance)});
  }
  require_in({0.0, 1e6}, accuracy.creep_steps, "accuracy.creep_steps", errors);
  require_in({1.0, 1e6}, accuracy.rest_iterations, "accuracy.rest_iterations", errors);
  positive(accuracy.residual_tolerance, "accuracy.residual_tolerance");
  positive(accuracy.kinetic_tolerance, "accuracy.kinetic_tolerance");
  positive(accuracy.contact_tolerance, "accuracy.contact_tolerance");
  positive(accuracy.overlap_tolerance, "accuracy.overlap_tolerance");
  positive(accuracy.imbalance_tolerance, "accuracy.imbalance_tolerance");
  require_in({0.0, 0.01, true, false}, accuracy.imbalance_gap, "accuracy.imbalance_gap", errors);
  if (accuracy.max_steps < 1) {
    errors.push_back(
        {"accuracy.max_steps", "must be at least 1, is " + std::to_string(accuracy.max_steps)});
  }
}

void check_gap_tolerances(const std::vector<double>& tolerances, Errors& errors) {
  const char* path = "measure.gap_tolerances";
  if (tolerances.empty() || tolerances.size() > most_gap_tolerances) {
    errors.push_back({path, "must hold 1 to " + std::to_string(most_gap_tolerances) +
                                " tolerances, holds " + std::to_string(tolerances.size())});
    return;
  }
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    require_in({0.0, 0.1, true, true}, tolerances[i], path, errors);
    const auto here = tolerances.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(tolerances.begin(), here, *here) != here) {
      errors.push_back(
          {path, "must hold distinct tolerances, holds " + bound_text(*here) + " twice"});
    }
  }
}

void check_bin_width(double bin_width, const Box& box, Errors& errors) {
  const double widest = box.is_tube ? box.width / 2.0 : box.width;
  if (bin_width >= finest_bin && bin_width <= widest) return;
  const char* bound = box.is_tube ? "half of tube.diameter" : "box.width";
  errors.push_back({"measure.bin_width", "must lie in [" + bound_text(finest_bin) + ", " +
                                             bound_text(widest) + "] (no wider than " + bound +
                                             "), is " + bound_text(bin_width)});
}

/// In extents of a grain. A step takes a round wall for its tangent plane at a corner of a
/// polyhedron: the narrower the tube, the further a corner slides off it.
constexpr double narrowest_tube = 2.5;

/// The extent by which narrow tubes are judged, d: of placed grains the mean of a component, so
/// that beds that were packed in a tube can be packed in it again.
double extent_in_tube(const PackingSpec& spec, const ShapeExtent& shape) {
  const auto* placed = std::get_if<PlacedGrains>(&spec.fill);
  if (placed == nullptr) return outcome_extent(spec, shape);
  constexpr double scatter = 0.01;  // of the mean of a hundred grains
  double largest = 0.0;
  for (const auto& [component, one] : placed_extents(*placed, spec.shape, shape)) {
    largest = std::max(largest, one.total / static_cast<double>(one.grains));
  }
  return (1.0 - scatter) * largest;
}

/// A tube of grains that turn, of that extent, d.
void check_tube(double diameter, double extent, Errors& errors) {
  const double narrowest = narrowest_tube * extent;
  const bool is_too_narrow = diameter < narrowest;  // what is no number is told of elsewhere
  if (!is_too_narrow) return;
  errors.push_back({"tube.diameter",
                    "must be at least " + least_text(narrowest) + " (" +
                        bound_text(narrowest_tube) + " times the extent of these grains), is " +
                        bound_text(diameter),
                    diameter > 0.0 ? narrowest / diameter : 0.0});
}

void check_measure(const MeasureSpec& measure, Errors& errors) {
  require_in({0.0, 1000.0}, measure.exclude_floor, "measure.exclude_floor", errors);
  require_in({0.0, 1000.0}, measure.exclude_surface, "measure.exclude_surface", errors);
  check_gap_tolerances(measure.gap_tolerances, errors);
}

/// Largest volume of a mixture's components over the least.
double volume_ratio(const Mixture& mixture) {
  std::vector<double> volumes;
  for (const MixtureComponent& component : mixture.components) {
    if (component.share > 0.0) volumes.push_back(extent_of(component.shape).volume);
  }
  const auto [least, most] = std::minmax_element(volumes.begin(), volumes.end());
  return volumes.empty() ? 1.0 : *most / *least;
}

/// The heaviest of placed grains over the lightest.
double mass_ratio(const PlacedGrains& placed, const ShapeSpec& shape) {
  // Of size 1; of grains of one shape they cancel.
  const std::vector<ShapeExtent> components = component_extents(shape);
  double least = infinity, most = 0.0;
  const double largest = largest_radius(placed);  // whose cube may be no number
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    const double radius = placed.grains[i].radius / largest;
    const double mass = radius * radius * radius *
                        (components.empty() ? 1.0 : components[placed.components[i]].volume);
    least = std::min(least, mass);
    most = std::max(most, mass);
  }
  return most / least;
}

/// Checks what is certain to be packed: placed grains, sizes of two classes, components of a
/// mixture; for distributions and the spread of sizes it depends on what is drawn.
void check_masses(const PackingSpec& spec, bool is_right, Errors& errors) {
  const SizesSpec& sizes = spec.sizes;
  const bool is_f32 = spec.accuracy.precision == Precision::f32;
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    if (!is_right || !is_f32 || mass_ratio(*placed, spec.shape) <= f32_mass_ratio) return;
    errors.push_back({"fill.file", "has grains of " + number_text(mass_ratio(*placed, spec.shape)) +
                                       " times each other's mass, and in f32 masses may differ by "
                                       "1e5 to 1; take accuracy.precision f64"});
    return;
  }
  const auto* mixture = std::get_if<Mixture>(&spec.shape);
  if (is_right && mixture != nullptr && is_f32 && volume_ratio(*mixture) > f32_mass_ratio) {
    errors.push_back({"shape.mixture", "has components of " + number_text(volume_ratio(*mixture)) +
                                           " times each other's volume, and in f32 masses may "
                                           "differ by 1e5 to 1; take accuracy.precision f64"});
    return;
  }
  const bool has_both = !sizes.distribution && sizes.small_share > 0.0 && sizes.small_share < 1.0;
  const double least = std::cbrt(1.0 / f32_mass_ratio);
  if (!has_both || !is_f32 || sizes.size_ratio >= least) return;
  errors.push_back({"sizes.size_ratio", "must be at least " + least_text(least) +
                                            " in f32, in which masses may differ by 1e5 to 1, is " +
                                            bound_text(sizes.size_ratio) +
                                            "; take accuracy.precision f64"});
}

/// In diameters. Nearer walls press on grains of one size more than a hundred times as hard as the
/// grains on each other, without bound where they leave no room, and hold them in many ways: of
/// four to eight beds none was found at exact rest within 1.001 d, some at 1.005 d to 1.01 d, all
/// at 1.02.
constexpr double narrowest_exact = 1.005;

/// Whether all large grains are of one size, up to rounding.
bool has_equal_grains(const PackingSpec& spec) {
  constexpr double equal = 1e-6;
  if (std::holds_alternative<PlacedGrains>(spec.fill)) return false;
  if (!spec.sizes.distribution) return spec.sizes.spread < equal;
  const std::vector<double> diameters = curve_of(*spec.sizes.distribution).diameters;
  return diameters.back() < (1.0 + equal) * diameters.front();
}

void check_exact_rest(const PackingSpec& spec, double largest, Errors& errors) {
  if (!is_sphere(spec.shape)) {
    errors.push_back(
        {"accuracy.rest",
         "must be in_steps for grains that are not spheres, is exact; accurate is the preset that "
         "settles them best"});
    return;
  }
  const bool have_room = nearest_walls(spec.box) >= narrowest_exact * largest;
  if (have_room || !has_equal_grains(spec)) return;
  errors.push_back({"accuracy.rest", "must be in_steps where walls are nearer than " +
                                         bound_text(narrowest_exact * largest) +
                                         " d and hold every large grain on both sides, is exact"});
}

}  // namespace

double probable_height(const PackingSpec& spec) {
  const double across = outcome_extent(spec, extent_of(spec.shape));
  return solid_height(spec) / usual_solid_fraction(spec, across);
}

std::string enough_fill(const PackingSpec& spec) {
  const double times = enough_over_given(spec);
  if (const auto* grains = std::get_if<GrainCount>(&spec.fill)) {
    return joined("fill.grains ",
                  static_cast<std::int64_t>(std::ceil(static_cast<double>(grains->count) * times)));
  }
  const auto* solid = std::get_if<SolidHeight>(&spec.fill);
  return solid == nullptr ? "" : "fill.solid_height " + number_text(solid->height * times);
}

std::vector<SpecError> check(const PackingSpec& spec) {
  Errors errors;
  const auto shape = check_shape(spec.shape, errors);
  const bool sizes = check_sizes(spec.sizes, errors);
  const double across = shape ? 2.0 * shape->circumradius : 1.0;
  const double largest = shape && sizes ? largest_grain(spec, *shape) : across;
  const bool has_room = check_room(spec, across, largest, errors);
  const bool box = has_room && check_box(spec.box, largest, errors);
  if (has_room && spec.box.is_tube && !is_sphere(spec.shape)) {
    check_tube(spec.box.length, shape && sizes ? extent_in_tube(spec, *shape) : across, errors);
  }
  check_fill(spec, shape, shape && sizes && box, errors);
  check_accuracy(spec.accuracy, errors);
  if (sizes) check_masses(spec, shape && errors.empty(), errors);
  if (spec.accuracy.rest == Rest::exact) check_exact_rest(spec, largest, errors);
  check_measure(spec.measure, errors);
  if (box) check_bin_width(spec.measure.bin_width, spec.box, errors);
  if (errors.empty()) check_outcome(spec, *shape, errors);
  if (shape) hint_at_size(spec.shape, errors);
  return errors;
}

std::int64_t grain_count(const PackingSpec& spec) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    return static_cast<std::int64_t>(placed->grains.size());
  }
  if (const auto* grains = std::get_if<GrainCount>(&spec.fill)) return grains->count;
  const ClassCounts counts = class_counts(spec);
  return counts.large + counts.small;
}

}  // namespace grainsweep
