#include <cmath>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "engine/shape/given_shape.hpp"
#include "engine/shape/named_shapes.hpp"
#include "engine/units.hpp"

namespace grainsweep {
namespace {

const double golden = (1.0 + std::sqrt(5.0)) / 2.0;

/// What is known of a solid in closed form.
struct Known {
  std::size_t corners, faces, edges, edge_directions;
  double volume, moment;  ///< d^3; of inertia over mass about z, d^2
  double inradius, circumradius;
};

void check_solid(const ShapeSpec& spec, const Known& known) {
  const Hull hull = shape_of(spec);
  INFO(name_of(spec) << hull.error);
  REQUIRE(hull.shape);
  const ConvexShape& shape = *hull.shape;
  CHECK(corner_count(spec) == known.corners);
  CHECK(shape.vertices.size() == known.corners);
  CHECK(shape.faces.size() == known.faces);
  CHECK(shape.edges.size() == known.edges);
  CHECK(shape.edge_directions.size() == known.edge_directions);
  constexpr double rounding = 1e-14;  // sums of at most 60 corners near 1
  CHECK(shape.volume == Approx(known.volume).epsilon(rounding));
  CHECK(shape.inertia.z() == Approx(known.moment).epsilon(rounding));
  CHECK(shape.inradius == Approx(known.inradius).epsilon(rounding));
  CHECK(shape.circumradius == Approx(known.circumradius).epsilon(rounding));
  CHECK(shape.given.rotation.isIdentity(0.0));
  CHECK(shape.given.centroid.norm() < rounding);
}

/// From the volume, moment and radii of a solid of edge 1 to those of one of this edge.
Known of_edge(double edge, Known known) {
  known.volume *= edge * edge * edge;
  known.moment *= edge * edge;
  known.inradius *= edge;
  known.circumradius *= edge;
  return known;
}

std::string problem_of(const ShapeSpec& spec) {
  const Hull hull = shape_of(spec);
  CHECK(hull.shape.has_value() == hull.error.empty());
  return hull.error;
}

}  // namespace

TEST_CASE("the regular solids have their closed forms and stand d high on a face") {
  const double g = golden, g2 = g * g;
  check_solid(CubeSize{}, {8, 6, 12, 3, 1.0, 1.0 / 6, 0.5, std::sqrt(3.0) / 2});
  check_solid(TetrahedronSize{}, of_edge(std::sqrt(1.5), {4, 4, 6, 6, 1 / std::sqrt(72.0), 1.0 / 20,
                                                          1 / std::sqrt(24.0), std::sqrt(0.375)}));
  check_solid(OctahedronSize{}, of_edge(std::sqrt(1.5), {6, 8, 12, 6, std::sqrt(2.0) / 3, 0.1,
                                                         1 / std::sqrt(6.0), std::sqrt(0.5)}));
  // Inertia of the last two: (39 g + 28) / 150 and g^2 / 10 of edge 1 (Satterly, Math. Gazette 42,
  // 1958).
  const double dodecahedron = std::sqrt(3 - g) / g2;  // edge of one d from face to face
  check_solid(
      DodecahedronSize{},
      of_edge(dodecahedron, {20, 12, 30, 15, (15 + 7 * std::sqrt(5.0)) / 4, (39 * g + 28) / 150,
                             g2 / (2 * std::sqrt(3 - g)), std::sqrt(3.0) * g / 2}));
  const double icosahedron = std::sqrt(3.0) / g2;
  check_solid(IcosahedronSize{},
              of_edge(icosahedron, {12, 20, 30, 15, 5 * g2 / 6, g2 / 10, g2 / (2 * std::sqrt(3.0)),
                                    std::sqrt(g * std::sqrt(5.0)) / 2}));
  for (const ShapeSpec& spec : {ShapeSpec(CubeSize{}), ShapeSpec(OctahedronSize{}),
                                ShapeSpec(DodecahedronSize{}), ShapeSpec(IcosahedronSize{})}) {
    CHECK(extent_of(spec).inradius == Approx(0.5).epsilon(1e-14));
  }
  const ShapeExtent tetrahedron = extent_of(TetrahedronSize{});
  CHECK(tetrahedron.inradius + tetrahedron.circumradius == Approx(1).epsilon(1e-14));
}

TEST_CASE("their parts are lengths") {
  check_solid(CubeSize{0.5}, of_edge(0.5, {8, 6, 12, 3, 1.0, 1.0 / 6, 0.5, std::sqrt(3.0) / 2}));
  check_solid(CuboidSize{3, 2, 0.5},
              {8, 6, 12, 3, 3, (9.0 + 4.0) / 12, 0.25, std::sqrt(9 + 4 + 0.25) / 2});
  check_solid(OctahedronSize{std::sqrt(6.0)}, of_edge(3, {6, 8, 12, 6, std::sqrt(2.0) / 3, 0.1,
                                                          1 / std::sqrt(6.0), std::sqrt(0.5)}));
}

TEST_CASE("a prism has the volume and inertia of its polygon times its height") {
  for (const int sides : {3, 4, 5, 6, 7, 16, 31}) {
    const double turn = 2 * pi / sides, radius = 0.6, height = 0.8;
    const double area = sides / 2.0 * radius * radius * std::sin(turn);
    const auto n = static_cast<std::size_t>(sides);
    const std::size_t directions = 1 + (n % 2 == 0 ? n / 2 : n);
    check_solid(
        PrismSize{sides, height, 2 * radius},
        {2 * n, n + 2, 3 * n, directions, area * height, radius * radius / 6 * (2 + std::cos(turn)),
         std::min(height / 2, radius * std::cos(turn / 2)), std::hypot(radius, height / 2)});
  }
}

TEST_CASE("a cylinder is the prism of the fewest sides within its chord error") {
  for (const double error : {0.2, 0.05, 0.01, 1e-3, 1.3e-4}) {
    const CylinderSize size{1.5, 2.0, error};
    const int sides = sides_of(size);
    INFO(error << ": " << sides << " sides");
    CHECK(1.0 - std::cos(pi / sides) <= error);
    CHECK((sides == 3 || 1.0 - std::cos(pi / (sides - 1)) > error));
    const ConvexShape cylinder = *shape_of(size).shape,
                      prism = *shape_of(PrismSize{sides, 1.5, 2.0}).shape;
    CHECK(cylinder.vertices == prism.vertices);
    CHECK(cylinder.volume == prism.volume);
  }
  CHECK(sides_of(CylinderSize{}) == 16);
}

TEST_CASE("solids of no size, too few sides or too fine a chord error are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(problem_of(CubeSize{0}) == "edge must lie in [1e-06, 10000], is 0");
  CHECK(problem_of(CuboidSize{1, -2, 1}) == "width must lie in [1e-06, 10000], is -2");
  CHECK(problem_of(TetrahedronSize{nan}) == "height must lie in [1e-06, 10000], is nan");
  CHECK(problem_of(OctahedronSize{-1}) == "height must lie in [1e-06, 10000], is -1");
  CHECK(problem_of(DodecahedronSize{0}) == "height must lie in [1e-06, 10000], is 0");
  CHECK(problem_of(IcosahedronSize{0}) == "height must lie in [1e-06, 10000], is 0");
  CHECK(problem_of(CubeSize{1e100}) == "edge must lie in [1e-06, 10000], is 1e+100");
  CHECK(problem_of(CubeSize{1e-200}) == "edge must lie in [1e-06, 10000], is 1e-200");
  CHECK(problem_of(PrismSize{2}) == "sides must be 3 to 200, is 2");
  CHECK(problem_of(PrismSize{201}) == "sides must be 3 to 200, is 201");
  CHECK(problem_of(PrismSize{3, 1, 0}) == "diameter must lie in [1e-06, 10000], is 0");
  CHECK(problem_of(CylinderSize{1, 1, 0}) == "chord_error must lie in [1e-06, 10000], is 0");
  CHECK(problem_of(CylinderSize{1, 1, 1e-5}) ==
        "chord_error must be at least 6.16844e-05, for which the diameter of 1 d takes 200 sides, "
        "is 1e-05");
  CHECK(problem_of(CylinderSize{1, 1, 6.16844e-5}).empty());  // as it asks for
  CHECK(problem_of(PrismSize{200, 0.1, 3}).empty());
}

}  // namespace grainsweep
