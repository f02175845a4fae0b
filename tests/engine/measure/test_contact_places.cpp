#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/contact_places.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::walls;

// Coordinates of a few d, rounded.
constexpr double rounding = 1e-12;

void check_place(const ContactPlace& place, const Vector& normal, const Vector& point,
                 int constraints) {
  CHECK((place.normal - normal).norm() < rounding);
  CHECK((place.point - point).norm() < rounding);
  CHECK(place.constraints == constraints);
}

TEST_CASE("spheres touch on the line of their centres, across a periodic side, too") {
  SphereBed bed =
      make_bed({6, 4, periodic, walls}, {{5.75, 2, 1, 0.5}, {0.26, 2, 1, 0.01}, {3, 0.5, 2, 0.5}});
  const Touching touching = find_touching(bed, 0.01, kernels());
  REQUIRE(touching.pairs.size() == 1);
  check_place(contact_place(bed, touching.pairs[0], 0.01), {1, 0, 0}, {6.25, 2, 1}, 1);
  REQUIRE(touching.walls.size() == 1);
  check_place(contact_place(bed, touching.walls[0], 0.01), {0, -1, 0}, {3, 0, 2}, 1);
}

TEST_CASE("what touches a wall with a gap does so midway") {
  SphereBed spheres = make_bed({6, 4, periodic, walls}, {{3, 0.55, 2, 0.5}});
  const Touching of_sphere = find_touching(spheres, 0.1, kernels());
  REQUIRE(of_sphere.walls.size() == 1);
  check_place(contact_place(spheres, of_sphere.walls[0], 0.1), {0, -1, 0}, {3, 0.025, 2}, 1);
  PolyhedronBed cube = testing::shape_bed({6, 6, periodic, walls}, testing::cube(),
                                          {{{3, 3, 0.55}, 1, Quaternion::Identity()}});
  const Touching of_cube = find_touching(cube, 0.1, kernels());
  REQUIRE(of_cube.walls.size() == 1);
  check_place(contact_place(cube, of_cube.walls[0], 0.1), {0, 0, -1}, {3, 3, 0.025}, 3);
}

TEST_CASE("a sphere touches the wall of a tube straight outward") {
  SphereBed bed = make_bed(tube_of(3), {{1.5 + 0.6, 1.5 + 0.8, 2, 0.5}});
  const Touching touching = find_touching(bed, 1e-6, kernels());
  REQUIRE(touching.walls.size() == 1);
  check_place(contact_place(bed, touching.walls[0], 1e-6), {0.6, 0.8, 0}, {2.4, 2.7, 2}, 1);
}

/// A cube on the floor, one beside it on an edge above it, and one on a corner above all, .001
/// apart from what they stand on.
PolyhedronBed cubes() {
  const Quaternion on_edge(Eigen::AngleAxisd(0.78539816339744831, Vector::UnitX()));
  const Vector diagonal = Vector(1, 1, 1).normalized();
  const Quaternion on_corner = Quaternion::FromTwoVectors(diagonal, Vector::UnitZ());
  const double half = 0.5, edge = std::sqrt(0.5), corner = std::sqrt(0.75), gap = 0.001;
  return testing::shape_bed({9, 9, periodic, walls}, testing::cube(),
                            {{{2, 2, half}, 1, Quaternion::Identity()},
                             {{2, 2, 3 * half + gap}, 1, Quaternion::Identity()},
                             {{2, 2, 4 * half + edge + 2 * gap}, 1, on_edge},
                             {{6, 2, half}, 1, Quaternion::Identity()},
                             {{6, 2, 2 * half + corner + gap}, 1, on_corner}});
}

TEST_CASE("cubes touch at a corner, along an edge or over a face, in its middle") {
  PolyhedronBed bed = cubes();
  const double reach = 0.002;
  const Touching touching = find_touching(bed, reach, kernels());
  REQUIRE(touching.pairs.size() == 3);
  for (const TouchingPair& pair : touching.pairs) {
    const ContactPlace place = contact_place(bed, pair, reach);
    INFO(pair.a << " and " << pair.b);
    if (pair.a == 0) check_place(place, {0, 0, 1}, {2, 2, 1.0005}, 3);
    if (pair.a == 1) check_place(place, {0, 0, 1}, {2, 2, 2.0015}, 2);
    if (pair.a == 3) check_place(place, {0, 0, 1}, {6, 2, 1.0005}, 1);
  }
  REQUIRE(touching.walls.size() == 2);
  check_place(contact_place(bed, touching.walls[0], reach), {0, 0, -1}, {2, 2, 0}, 3);
}

TEST_CASE("a contact wider than the tolerance that it is asked for is one at a point") {
  PolyhedronBed bed = cubes();
  for (const TouchingPair& pair : find_touching(bed, 0.002, kernels()).pairs) {
    const ContactPlace place = contact_place(bed, pair, 1e-4);
    CHECK(place.constraints == 1);
    CHECK((place.normal - Vector::UnitZ()).norm() < rounding);
  }
}

TEST_CASE("every vertex of a cube lies at a tube with a normal and a gap of its own") {
  // Its corners are at 1 / 4 and 5 / 4 d along x from the axis, 1 / 2 d to both sides.
  const PolyhedronBed bed =
      testing::shape_bed(tube_of(4), testing::cube(), {{{2.75, 2, 1}, 1, Quaternion::Identity()}});
  const auto places = vertex_places(bed, {0, 1, 0});
  REQUIRE(places.size() == 8);
  for (const VertexPlace& at : places) {
    const Vector corner = bed.shape(0).vertices[static_cast<std::size_t>(at.vertex)];
    const Vector from_axis(0.75 + corner.x(), corner.y(), 0);
    const Vector outward = from_axis.normalized();
    CHECK(at.gap == Approx(2 - from_axis.norm()));
    check_place(at.place, outward,
                Vector(2, 2, 1 + corner.z()) + (from_axis.norm() + at.gap / 2) * outward, 1);
  }
}

}  // namespace
}  // namespace grainsweep
