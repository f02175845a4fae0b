// Solids that need no vertices: cube, cuboid, the other regular solids, prism and cylinder.
//
// Each is the hull of the corners given here, whose centroid is the origin and whose axes of
// symmetry are those of the frame; the axis of a prism is z.
#pragma once

#include <string>
#include <vector>

#include "engine/shape/convex_shape.hpp"
#include "engine/shape/lengths.hpp"
#include "engine/shape/shape_spec.hpp"
namespace grainsweep {

/// Most sides of a prism: a cylinder of chord error 1e-4 of its diameter has 158.
inline constexpr int most_sides = 200;

/// Sides of the prism that stands for a cylinder: the fewest with
/// diameter / 2 (1 - cos(pi / sides)) <= chord_error, 3 at least. Requires a positive chord error.
int sides_of(const CylinderSize& size);

/// What forbids such a solid, with what to change; "" if nothing does.
std::string problem_with(const CubeSize& size);
std::string problem_with(const CuboidSize& size);
template <int faces>
std::string problem_with(const RegularSolid<faces>& size) {
  return problem_with_length("height", size.height);
}
std::string problem_with(const PrismSize& size);
std::string problem_with(const CylinderSize& size);

/// Its corners, d. Requires problem_with(size).empty().
std::vector<Vector> corners_of(const CubeSize& size);
std::vector<Vector> corners_of(const CuboidSize& size);
std::vector<Vector> corners_of(const TetrahedronSize& size);
std::vector<Vector> corners_of(const OctahedronSize& size);
std::vector<Vector> corners_of(const DodecahedronSize& size);
std::vector<Vector> corners_of(const IcosahedronSize& size);
std::vector<Vector> corners_of(const PrismSize& size);
std::vector<Vector> corners_of(const CylinderSize& size);

}  // namespace grainsweep
