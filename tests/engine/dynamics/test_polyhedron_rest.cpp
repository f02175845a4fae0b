#include <catch2/catch.hpp>

#include "engine/dynamics/rest.hpp"
#include "engine/shape/mixture.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::pose_at;
using testing::shape_bed;
using testing::walls;

/// As measured after a step that is solved far below every number that is compared, and after which
/// the first grain is lowered by so much.
RestReport rest_after_step(PolyhedronBed& bed, double lowered) {
  StepState<Polyhedron, double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  bed.position[0].z -= lowered;
  return measure_rest(bed, kernels(), settings.dt, state);
}

TEST_CASE("a lone grain on the floor has three constraints and is isostatic") {
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  const RestReport rest = rest_after_step(bed, 0.0);
  CHECK(rest.contacts == 3);
  CHECK(rest.isostatic_contacts == 3);
  CHECK(rest.overlap_max < 1e-6);
}

TEST_CASE("spheres of a mixture have three freedoms, and hold a polyhedron they push by turning") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  const Quaternion upright = Quaternion::Identity();
  PolyhedronBed bed = make_bed({6, 6, periodic, walls}, shapes, {0, 1, 1, 1},
                               {pose_at(3, 3, 0.5), pose_at(2.8, 3, 1.2, upright, 0.4),
                                pose_at(3.2, 3, 1.2, upright, 0.4), pose_at(5, 1, 0.5)});
  CHECK(degrees_of_freedom(bed) == 6 + 3 * 3);
  const RestReport rest = rest_after_step(bed, 0.0);
  CHECK(rest.contacts == 3 + 2 + 1);
  CHECK(rest.held_by_turning == 3);  // of 2 by each sphere
  // Less two translations of the cube and its spheres, and of the sphere that lies alone.
  CHECK(rest.isostatic_contacts == 6 + 3 * 3 - 2 - 2);
}

TEST_CASE(
    "a round wall holds a sphere of a mixture along it, too, as it holds one of a sphere bed") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  PolyhedronBed bed =
      make_bed(tube_of(1.6), shapes, {1, 1}, {pose_at(0.5, 0.8, 0.5), pose_at(1.1, 0.8, 1.3)});
  const RestReport rest = rest_after_step(bed, 0.0);
  CHECK(rest.contacts == 4);
  CHECK(rest.held_by_turning == 2);
}

TEST_CASE("overlaps are measured where the grains are, at the deepest point") {
  PolyhedronBed bed = shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  const RestReport rest = rest_after_step(bed, 0.01);
  CHECK(rest.overlap_max == about(0.01, 1e-6));
  CHECK(rest.overlap_mean == about(0.01, 1e-6));
}

/// Modes that move no contact, of cubes in a row along x that push each other.
std::int64_t modes_of_a_row(const Box& box, std::int32_t cubes,
                            std::vector<ForceContact> contacts) {
  std::vector<Pose> poses;
  for (std::int32_t i = 0; i < cubes; ++i) poses.push_back(pose_at(0.5 + i, 0.5, 0.5));
  const PolyhedronBed bed = shape_bed(box, testing::cube(), poses);
  for (ForceContact& wall : contacts) wall.b = bed.wall_name(static_cast<std::size_t>(wall.b));
  for (std::int32_t i = 0; i + 1 < cubes; ++i) contacts.push_back({i, i + 1, 1.0});
  return zero_modes(bed, contacts);
}

// Grains that turn have six degrees of freedom, and as many contacts less the ways to move all of
// them at once: along each axis without walls. Only a grain by itself may also turn where it lies.
TEST_CASE(
    "a cluster of turning grains slides along every axis that no wall bounds, but never turns") {
  const ForceContact floor{0, 0, 1.0}, side{0, 1, 1.0};
  CHECK(modes_of_a_row({6, 6, periodic, periodic}, 3, {floor}) == 2);
  CHECK(modes_of_a_row({6, 6, periodic, walls}, 3, {floor, side}) == 1);
  CHECK(modes_of_a_row({6, 6, periodic, periodic}, 1, {floor}) == 3);
  CHECK(modes_of_a_row({6, 6, periodic, walls}, 1, {floor, side}) == 1);
}

TEST_CASE("each vertex at the wall of a tube has a force of its own, the floor one in all") {
  const PolyhedronBed bed = shape_bed(tube_of(4), testing::cube(), {pose_at(2, 2, 0.5)});
  const std::int32_t floor = bed.wall_name(0), round = floor + tube_wall;
  const auto forces =
      wall_forces(bed, {{0, round, 1.0}, {0, floor, 2.0}, {0, round + 3, 4.0}, {0, floor, 8.0}}, {})
          .first;
  REQUIRE(forces.size() == 3);
  CHECK((forces[0].wall == 0 && forces[0].magnitude == 10.0));
  CHECK((forces[1].wall == wall_of_vertex(0) && forces[1].magnitude == 1.0));
  CHECK((forces[2].wall == wall_of_vertex(3) && forces[2].magnitude == 4.0));
}

TEST_CASE("a grain alone in a tube slides and spins, which a turn about the axis amounts to") {
  const PolyhedronBed bed = shape_bed(tube_of(4), testing::cube(), {pose_at(2.5, 2, 0.5)});
  CHECK(zero_modes(bed, {{0, bed.wall_name(0), 1.0}}) == 3);
}

// Three ways to move on the floor, less one for each direction in which the wall pushes it.
TEST_CASE("the wall of a tube pushes each vertex towards the axis from where that is") {
  const PolyhedronBed bed = shape_bed(tube_of(4), testing::cube(), {pose_at(3.4, 2, 0.5)});
  const std::vector<Vector>& vertices = bed.shapes.front().vertices;
  std::vector<std::int32_t> left, right;  // of the side towards the wall
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].x() < 0.0) continue;
    (vertices[v].y() < 0.0 ? left : right).push_back(static_cast<std::int32_t>(v));
  }
  REQUIRE(left.size() == 2);
  REQUIRE(right.size() == 2);
  const auto modes_with = [&](const std::vector<std::int32_t>& touching) {
    std::vector<ForceContact> contacts = {{0, bed.wall_name(0), 1.0}};
    for (const std::int32_t v : touching) contacts.push_back({0, bed.wall_name(1) + v, 1.0});
    return zero_modes(bed, contacts);
  };
  CHECK(modes_with({left[0]}) == 2);
  CHECK(modes_with({left[0], left[1]}) == 2);  // one above the other
  CHECK(modes_with({left[0], right[0]}) == 1);
  CHECK(modes_with({left[0], left[1], right[0], right[1]}) == 1);
}

}  // namespace
}  // namespace grainsweep
