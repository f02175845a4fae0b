#include "engine/shape/given_shape.hpp"

#include "engine/shape/pinacoid.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

Hull shape_from(const PinacoidSize& size) {
  const std::string problem = problem_with(size);
  return problem.empty() ? Hull{pinacoid(size), ""} : Hull{std::nullopt, problem};
}

Hull shape_from(const HullVertices& hull) {
  std::vector<Vector> points;
  points.reserve(hull.points.size());
  for (const auto& [x, y, z] : hull.points) points.emplace_back(x, y, z);
  return convex_hull(points);
}

}  // namespace

Hull shape_of(const ShapeSpec& spec) {
  const auto* hull = std::get_if<HullVertices>(&spec);
  return hull != nullptr ? shape_from(*hull) : shape_from(std::get<PinacoidSize>(spec));
}

ShapeExtent extent_of(const ConvexShape& shape) {
  return {shape.volume, shape.circumradius, shape.inradius};
}

ShapeExtent extent_of(const ShapeSpec& spec) {
  return is_sphere(spec) ? ShapeExtent{sphere_volume(0.5), 0.5, 0.5}
                         : extent_of(*shape_of(spec).shape);
}

}  // namespace grainsweep
