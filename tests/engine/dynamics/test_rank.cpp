#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/rank.hpp"
#include "engine/dynamics/step.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::ContactName;
using testing::kernels;
using testing::periodic;
using testing::wall_name;
using testing::walls;

constexpr double step_time = 0.5;

/// Rank of a bed in which the named contacts push.
std::int64_t rank_of(SphereBed bed, const std::vector<ContactName>& pushing) {
  auto contacts = testing::contacts_of<double>(bed, 0.01, kernels());
  for (const ContactName& name : pushing) {
    testing::set_impulses(bed, {{name, 0.3}}, contacts);
  }
  return independent_constraints(bed, kernels(), step_time, contacts);
}

TEST_CASE("the contacts of a column are independent") {
  const SphereBed bed = testing::column_bed(5, 0.0);
  CHECK(rank_of(bed, {{0, wall_name(bed, 0)}, {0, 1}, {1, 2}, {2, 3}, {3, 4}}) == 5);
}

TEST_CASE("walls that hold a sphere between them are no constraints") {
  const SphereBed bed = make_bed({6, 1, periodic, walls}, {{2, 0.5, 0.5, 0.5}});
  CHECK(rank_of(bed, {{0, wall_name(bed, 0)}, {0, wall_name(bed, 1)}, {0, wall_name(bed, 2)}}) ==
        1);
}

// The small one between floor, wall and large one: what it pushes the large one with along y is the
// walls' to bear, and the floor bears the rest of it.
TEST_CASE("a sphere that fills the space between walls takes no push across it") {
  const double small = 0.5 * (std::sqrt(2.0) - 1.0) / (std::sqrt(2.0) + 1.0);
  const SphereBed bed =
      make_bed({6, 1, periodic, walls}, {{2, small, small, small}, {2, 0.5, 0.5, 0.5}});
  const auto floor = wall_name(bed, 0), wall = wall_name(bed, 1);
  CHECK(rank_of(bed, {{0, floor}, {0, wall}, {0, 1}, {1, floor}}) == 3);
}

TEST_CASE("a bed in which nothing pushes has no constraints") {
  CHECK(rank_of(make_bed({6, 4, periodic, walls}, {{2, 0.5, 3.0, 0.4}}), {}) == 0);
}

TEST_CASE("a row of four spheres between two walls has one contact more than it needs") {
  const SphereBed bed = make_bed(
      {4, 1, walls, periodic},
      {{0.5, 0.5, 0.5, 0.5}, {1.5, 0.5, 0.5, 0.5}, {2.5, 0.5, 0.5, 0.5}, {3.5, 0.5, 0.5, 0.5}});
  const auto left = wall_name(bed, 1), right = wall_name(bed, 2);
  CHECK(rank_of(bed, {{0, left}, {0, 1}, {1, 2}, {2, 3}, {3, right}}) == 4);
}

TEST_CASE("a row that is bent, however little, gives way: all its contacts are independent") {
  for (const double bend : {0.01, 1e-4}) {
    const double low = 1.5 - bend / 2, high = 1.5 + bend / 2;
    const SphereBed bed = make_bed(
        {4, 3, walls, periodic},
        {{0.5, low, 0.5, 0.5}, {1.5, high, 0.5, 0.5}, {2.5, low, 0.5, 0.5}, {3.5, high, 0.5, 0.5}});
    const auto left = wall_name(bed, 1), right = wall_name(bed, 2);
    CHECK(rank_of(bed, {{0, left}, {0, 1}, {1, 2}, {2, 3}, {3, right}}) == 5);
  }
}

/// Rank of a bed of cubes after a well-solved step from rest.
std::int64_t rank_of_cubes(const Box& box, const std::vector<Pose>& poses) {
  PolyhedronBed bed = testing::shape_bed(box, testing::cube(), poses);
  StepState<Polyhedron, double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  return independent_constraints(bed, kernels(), settings.dt, state.contacts);
}

TEST_CASE("a face on a face is three independent constraints") {
  CHECK(rank_of_cubes({6, 6, periodic, walls},
                      {testing::pose_at(3, 3, 0.5), testing::pose_at(3.1, 3, 1.5)}) == 6);
}

TEST_CASE("four cubes that bear a fifth together cannot all bear it on their own") {
  // The fifth stands on three constraints of each of the others, of which three are independent.
  std::vector<Pose> poses;
  for (const double x : {2.49, 3.51}) {
    for (const double y : {2.49, 3.51}) poses.push_back(testing::pose_at(x, y, 0.5));
  }
  poses.push_back(testing::pose_at(3, 3, 1.5));
  // The floor holds three motions of each of five cubes; what is above adds no more than three.
  CHECK(rank_of_cubes({6, 6, periodic, walls}, poses) == 4 * 3 + 3);
}

/// Rank of a cube flat on a wall and one between it and the opposite wall, which both push at
/// opposite corners, their diagonal turned by `tilt` about z from the normal of the walls.
std::int64_t rank_of_wedged_cubes(double tilt) {
  const Quaternion upright = Quaternion::FromTwoVectors(Vector(1, 1, 1), Vector::UnitX());
  const Quaternion turn = Quaternion(Eigen::AngleAxisd(tilt, Vector::UnitZ())) * upright;
  const double half = std::sqrt(0.75) * std::cos(tilt), overlap = 1e-6;
  const Box box{1.0 + 2.0 * half - 3.0 * overlap, 6, walls, periodic};
  return rank_of_cubes(box, {testing::pose_at(0.5 - overlap, 2, 3),
                             testing::pose_at(1.0 + half - 2.0 * overlap, 2.2, 2.9, turn)});
}

// The face on the wall is three constraints; what the corners of the other cube bear goes through
// its centre on one line, so that the second corner adds nothing.
TEST_CASE("opposite pushes on one line are one constraint, wherever other centres lie") {
  CHECK(rank_of_wedged_cubes(0.0) == 3 + 1);
}

TEST_CASE("opposite pushes beside each other turn a grain: both are independent") {
  CHECK(rank_of_wedged_cubes(0.05) == 3 + 2);
}

}  // namespace
}  // namespace grainsweep
