#include "engine/scene/spec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/scene/sizes.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/text.hpp"

namespace grainsweep {
namespace {

using Errors = std::vector<SpecError>;

constexpr double longest_side = 10'000.0;        // d; cell indices stay far below 32 bits
constexpr std::int64_t max_grains = 10'000'000;  // grain indices are 32 bits wide
constexpr double settled_wall_overlap = 0.01;    // d; far above that of any settled bed
constexpr double finest_bin = 0.01;              // d; finer bins hold noise and fill the disk
constexpr double image_margin = 0.2;             // d; candidates never reach farther than this

std::string text_of(double value) {
  if (std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15) {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  return number_text(value, 6);
}

struct Interval {
  double low = 0.0, high = 0.0;
  bool low_open = false, high_open = false;

  bool holds(double value) const {  // false for NaN
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
  std::string text() const {
    std::string text(low_open ? "(" : "[");
    text.append(text_of(low)).append(", ").append(text_of(high));
    return text + (high_open ? ")" : "]");
  }
};

bool require_in(const Interval& interval, double value, const char* path, Errors& errors) {
  if (interval.holds(value)) return true;
  errors.push_back({path, "must lie in " + interval.text() + ", is " + text_of(value)});
  return false;
}

/// Largest size that can occur.
double largest_size(const PackingSpec& spec) {
  if (const auto* placed = std::get_if<PlacedGrains>(&spec.fill)) {
    double radius = 0.0;
    for (const PlacedSphere& grain : placed->grains) radius = std::max(radius, grain.radius);
    return 2.0 * radius;
  }
  const double mean = spec.sizes.small_share < 1.0 ? 1.0 : spec.sizes.size_ratio;
  return mean * (1.0 + largest_deviation * spec.sizes.spread);
}

/// The shape's extent; nothing if something forbids it.
std::optional<ShapeExtent> check_shape(const ShapeSpec& spec, Errors& errors) {
  if (is_sphere(spec)) return extent_of(spec);
  const Hull hull = shape_of(spec);
  if (hull.shape) return extent_of(*hull.shape);
  const bool is_hull = std::holds_alternative<HullVertices>(spec);
  errors.push_back({is_hull ? "shape.hull" : "shape.pinacoid", hull.error});
  return std::nullopt;
}

bool check_sizes(const SizesSpec& sizes, Errors& errors) {
  const bool spread = require_in({0.0, 0.2}, sizes.spread, "sizes.spread", errors);
  const bool share = require_in({0.0, 1.0}, sizes.small_share, "sizes.small_share", errors);
  const bool ratio =
      require_in({0.02, 1.0, true, false}, sizes.size_ratio, "sizes.size_ratio", errors);
  return spread && share && ratio;
}

/// One horizontal side. Walls must hold the largest grain; a periodic side must be so long that no
/// grain meets two images of the same neighbour, or its own.
bool check_side(const char* path, double side, Boundary boundary, double shortest, double largest,
                Errors& errors) {
  const bool walls = boundary == Boundary::walls;
  const double needed =
      walls ? std::max(shortest, largest) : std::max(shortest, 2.0 * (largest + image_margin));
  if (side >= needed && side <= longest_side) return true;
  std::string reason;
  if (!walls && needed > shortest) reason = " (periodic: twice the largest grain and a margin)";
  if (walls && needed > shortest) reason = " (the largest grain between two walls)";
  errors.push_back({path, "must lie in [" + text_of(needed) + ", " + text_of(longest_side) + "]" +
                              reason + ", is " + text_of(side)});
  return false;
}

bool check_box(const Box& box, double largest, Errors& errors) {
  const bool length = check_side("box.length", box.length, box.x, 2.0, largest, errors);
  const bool width = check_side("box.width", box.width, box.y, 1.0, largest, errors);
  return length && width;
}

void require_count(std::int64_t count, const char* path, Errors& errors) {
  if (count >= 1 && count <= max_grains) return;
  errors.push_back({path, "must give 1 to " + std::to_string(max_grains) + " grains, gives " +
                              std::to_string(count)});
}

bool is_outside(double centre, double radius, double side, Boundary boundary) {
  const double reach = boundary == Boundary::walls ? radius - settled_wall_overlap : 0.0;
  return !(centre >= reach && centre <= side - reach);
}

/// What is wrong with one placed grain; empty if nothing is. A ball of `inner` times its size lies
/// within it.
std::string fault_of(const PlacedSphere& grain, double inner, const Box& box) {
  const double within = 2.0 * inner * grain.radius;
  if (!(grain.radius > 0.0 && grain.radius <= longest_side)) {
    return "the radius must be positive, is " + text_of(grain.radius);
  }
  if (is_outside(grain.x, within, box.length, box.x)) {
    return "lies outside the box: x = " + text_of(grain.x) + ", radius " + text_of(grain.radius) +
           ", box.length " + text_of(box.length);
  }
  if (is_outside(grain.y, within, box.width, box.y)) {
    return "lies outside the box: y = " + text_of(grain.y) + ", radius " + text_of(grain.radius) +
           ", box.width " + text_of(box.width);
  }
  if (!(grain.z >= within - settled_wall_overlap && grain.z <= longest_side)) {
    return "lies below the floor or too high: z = " + text_of(grain.z) + ", radius " +
           text_of(grain.radius);
  }
  return "";
}

/// A quaternion may have been rounded to single precision.
std::string fault_of(const std::array<double, 4>& q) {
  constexpr double rounding = 1e-5;
  const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (std::abs(squared - 1.0) <= rounding) return "";
  return "qx, qy, qz, qw must be a unit quaternion; their squares add up to " + text_of(squared);
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
void check_placed(const PlacedGrains& placed, double inner, const Box& box, Errors& errors) {
  std::string first;
  std::size_t bad = 0;
  for (std::size_t i = 0; i < placed.grains.size(); ++i) {
    std::string fault = fault_of(placed.grains[i], inner, box);
    if (fault.empty() && i < placed.orientations.size()) fault = fault_of(placed.orientations[i]);
    if (fault.empty()) continue;
    if (++bad == 1) first = "grain " + std::to_string(i + 1) + " " + fault;
  }
  if (bad == 0) return;
  const std::string more = bad == 1 ? "" : "; " + std::to_string(bad) + " grains are wrong in all";
  errors.push_back({"fill.file", first + more});
}

void check_fill(const PackingSpec& spec, const std::optional<ShapeExtent>& shape,
                bool counts_are_defined, Errors& errors) {
  if (const auto* solid = std::get_if<SolidHeight>(&spec.fill)) {
    const bool height =
        require_in({0.0, 1000.0, true, false}, solid->height, "fill.solid_height", errors);
    if (!height || !counts_are_defined) return;
    require_count(grain_count(spec), "fill.solid_height", errors);
  } else if (const auto* grains = std::get_if<GrainCount>(&spec.fill)) {
    require_count(grains->count, "fill.grains", errors);
  } else {
    const auto& placed = std::get<PlacedGrains>(spec.fill);
    require_count(grain_count(spec), "fill.file", errors);
    if (shape) check_placed(placed, shape->inradius, spec.box, errors);
    check_orientations(placed, is_sphere(spec.shape), errors);
  }
}

void check_accuracy(const Accuracy& accuracy, Errors& errors) {
  constexpr double most = std::numeric_limits<double>::max();
  const auto positive = [&](double value, const char* path) {
    if (value > 0.0 && value <= most) return;
    errors.push_back({path, "must be positive, is " + text_of(value)});
  };
  require_in({0.0, 2.0, true, false}, accuracy.step, "accuracy.step", errors);
  require_in({0.0, 1.0, false, true}, accuracy.momentum, "accuracy.momentum", errors);
  require_in({1.0, 1e6}, accuracy.fall_iterations, "accuracy.fall_iterations", errors);
  positive(accuracy.path_tolerance, "accuracy.path_tolerance");
  require_in({0.0, 1e6}, accuracy.creep_steps, "accuracy.creep_steps", errors);
  require_in({1.0, 1e6}, accuracy.rest_iterations, "accuracy.rest_iterations", errors);
  positive(accuracy.residual_tolerance, "accuracy.residual_tolerance");
  positive(accuracy.kinetic_tolerance, "accuracy.kinetic_tolerance");
  positive(accuracy.contact_tolerance, "accuracy.contact_tolerance");
  positive(accuracy.overlap_tolerance, "accuracy.overlap_tolerance");
  if (accuracy.max_steps < 1) {
    errors.push_back(
        {"accuracy.max_steps", "must be at least 1, is " + std::to_string(accuracy.max_steps)});
  }
}

void check_gap_tolerances(const std::vector<double>& tolerances, Errors& errors) {
  const char* path = "measure.gap_tolerances";
  if (tolerances.empty() || tolerances.size() > 8) {
    errors.push_back(
        {path, "must hold 1 to 8 tolerances, holds " + std::to_string(tolerances.size())});
    return;
  }
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    require_in({0.0, 0.1, true, true}, tolerances[i], path, errors);
    const auto here = tolerances.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(tolerances.begin(), here, *here) != here) {
      errors.push_back({path, "must hold distinct tolerances, holds " + text_of(*here) + " twice"});
    }
  }
}

void check_bin_width(double bin_width, double box_width, Errors& errors) {
  if (bin_width >= finest_bin && bin_width <= box_width) return;
  errors.push_back(
      {"measure.bin_width", "must lie in [" + text_of(finest_bin) + ", " + text_of(box_width) +
                                "] (no wider than box.width), is " + text_of(bin_width)});
}

void check_measure(const MeasureSpec& measure, Errors& errors) {
  require_in({0.0, 1000.0}, measure.exclude_floor, "measure.exclude_floor", errors);
  require_in({0.0, 1000.0}, measure.exclude_surface, "measure.exclude_surface", errors);
  check_gap_tolerances(measure.gap_tolerances, errors);
}

}  // namespace

std::vector<SpecError> check(const PackingSpec& spec) {
  Errors errors;
  const auto shape = check_shape(spec.shape, errors);
  const bool sizes = check_sizes(spec.sizes, errors);
  const double across = shape ? 2.0 * shape->circumradius : 1.0;
  const bool box = check_box(spec.box, across * (sizes ? largest_size(spec) : 1.0), errors);
  check_fill(spec, shape, shape && sizes && box, errors);
  check_accuracy(spec.accuracy, errors);
  check_measure(spec.measure, errors);
  if (box) check_bin_width(spec.measure.bin_width, spec.box.width, errors);
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
