#include "engine/shape/given_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/shape/mixture.hpp"
#include "engine/shape/named_shapes.hpp"
#include "engine/shape/pinacoid.hpp"
#include "engine/units.hpp"

namespace grainsweep {

namespace {

Hull shape_from(const SphereShape& /*sphere*/) {
  constexpr double radius = 0.5;  // d
  ConvexShape ball;
  ball.vertices = {Vector::Zero()};
  ball.volume = sphere_volume(radius);
  ball.inertia = Vector::Constant(0.4 * radius * radius);
  ball.circumradius = ball.inradius = radius;
  ball.is_ball = true;
  return {ball, ""};
}

/// Its components have one each.
[[noreturn]] Hull shape_from(const Mixture& /*mixture*/) {
  throw std::logic_error("a mixture is no single polyhedron");
}

Hull shape_from(const PinacoidSize& size) {
  const std::string problem = problem_with(size);
  return problem.empty() ? Hull{pinacoid(size), ""} : Hull{std::nullopt, problem};
}

Hull shape_from(const HullVertices& hull) {
  std::vector<Vector> points;
  points.reserve(hull.points.size());
  for (const auto& [x, y, z] : hull.points) points.emplace_back(x, y, z);
  Hull made = convex_hull(points, flat_as_written);
  const std::size_t vertices = made.shape ? made.shape->vertices.size() : 0;
  if (vertices <= most_vertices_of_a_grain) return made;
  return {std::nullopt,
          joined("must have at most ", most_vertices_of_a_grain, " vertices, has ", vertices)};
}

template <class Size>
Hull shape_from(const Size& size) {
  const std::string problem = problem_with(size);
  return problem.empty() ? convex_hull(corners_of(size)) : Hull{std::nullopt, problem};
}

struct CountCorners {
  std::size_t operator()(const SphereShape& /*sphere*/) const { return 0; }
  std::size_t operator()(const PinacoidSize& /*size*/) const { return 8; }
  std::size_t operator()(const HullVertices& hull) const { return hull.points.size(); }
  std::size_t operator()(const Mixture& mixture) const {
    const std::vector<double> shares = number_shares(mixture);
    double mean = 0.0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      mean += shares[k] * static_cast<double>(corner_count(mixture.components[k].shape));
    }
    return static_cast<std::size_t>(std::llround(mean));
  }
  template <class Size>
  std::size_t operator()(const Size& size) const {
    return corners_of(size).size();
  }
};

ShapeExtent mean_extent(const Mixture& mixture) {
  const std::vector<double> shares = number_shares(mixture);
  const auto present = static_cast<std::size_t>(
      std::find_if(shares.begin(), shares.end(), [](double share) { return share > 0.0; }) -
      shares.begin());
  ShapeExtent all = extent_of(mixture.components[present].shape);
  const double first = all.volume;  // so that equal components have its bits
  for (std::size_t k = present + 1; k < shares.size(); ++k) {
    if (shares[k] == 0.0) continue;
    const ShapeExtent one = extent_of(mixture.components[k].shape);
    all.volume += shares[k] * (one.volume - first);
    all.circumradius = std::max(all.circumradius, one.circumradius);
    all.inradius = std::min(all.inradius, one.inradius);
  }
  return all;
}

}  // namespace

Hull shape_of(const ShapeSpec& spec) {
  return std::visit([](const auto& size) { return shape_from(size); }, spec);
}

std::size_t corner_count(const ShapeSpec& spec) { return std::visit(CountCorners(), spec); }

ShapeExtent extent_of(const ConvexShape& shape) {
  return {shape.volume, shape.circumradius, shape.inradius};
}

ShapeExtent extent_of(const ShapeSpec& spec) {
  if (const auto* mixture = std::get_if<Mixture>(&spec)) return mean_extent(*mixture);
  return is_sphere(spec) ? ShapeExtent{sphere_volume(0.5), 0.5, 0.5}
                         : extent_of(*shape_of(spec).shape);
}

}  // namespace grainsweep
