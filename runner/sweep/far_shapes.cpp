#include "runner/sweep/far_shapes.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

#include "engine/shape/given_shape.hpp"
#include "engine/text.hpp"
#include "engine/units.hpp"

namespace grainsweep {
namespace {

/// Of the sphere of equal volume, d; of a mixture of the mean volume.
double diameter_of(const ShapeExtent& extent) { return std::cbrt(6.0 * extent.volume / pi); }

bool is_far(const ShapeExtent& extent) {
  constexpr double far = 3.0;
  const double diameter = diameter_of(extent);
  if (diameter > far) return 2.0 * extent.inradius > 1.0;
  return diameter < 1.0 / far && 2.0 * extent.circumradius < 1.0;
}

std::string remedy_of(const PackingSpec& spec, double diameter, const GivenUnits& units) {
  if (std::holds_alternative<HullVertices>(spec.shape)) {
    return "make shape.hull.size, the length in its vertices that is d, " + number_text(diameter) +
           " times as large";
  }
  const std::string shape = "shape." + std::string(name_of(spec.shape));
  constexpr double near = 2.0;
  const double in_units = units ? diameter / units->d : 0.0;
  if (in_units > 1.0 / near && in_units < near) {
    return "divide those of " + shape + " by " + number_text(units->d, 6) + ", which d is in " +
           units->unit;
  }
  return "divide those of " + shape + " by what d is in their unit";
}

}  // namespace

Diagnostics notes_on_far_shapes(const Sweep& sweep) {
  std::size_t sets = 0, far = 0;
  const Job* first = nullptr;
  for (const Job& job : sweep.jobs) {
    if (job.replicate != 1 || is_sphere(job.spec.shape)) continue;
    if (std::holds_alternative<PlacedGrains>(job.spec.fill)) continue;
    ++sets;
    if (!is_far(extent_of(job.spec.shape))) continue;
    if (++far == 1) first = &job;
  }
  if (first == nullptr) return {};
  const double diameter = diameter_of(extent_of(first->spec.shape));
  return {{sweep.block_pointers[first->block],
           joined("grains have the volume of a sphere of ", number_text(diameter), " d (", far,
                  " of ", sets,
                  " parameter sets with polyhedra): lengths of shapes, like all, are "
                  "in d, the mean diameter of the large grains; ",
                  remedy_of(first->spec, diameter, sweep.units)),
           Anchor::value, "", true}};
}

}  // namespace grainsweep
