// Candidates: hulls that move by steps of all lengths, and at each step the axes found with what
// the pair remembers against those of a search that remembers nothing.
#include <vector>

#include <catch2/catch.hpp>

#include "engine/narrow/manifold.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_pairs.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

std::vector<ConvexShape> shapes() {
  Draw draw(5);
  return {testing::cube(),
          testing::tetrahedron(),
          testing::dodecahedron(),
          testing::icosahedron(),
          testing::prism(16, 1),
          testing::prism(32, 0.5),
          testing::box_shape(1, 1, 0.1),
          testing::hull_of(testing::random_corners(draw, 20))};
}

/// Moves b by up to `length` and turns it by up to the same angle.
void move(Draw& draw, double length, PairPose& pose) {
  const auto vector = [&] {
    const Draw::Direction d = draw.direction();
    return Vector(d.x, d.y, d.z);
  };
  pose.centre += draw.uniform(0.0, length) * vector();
  const Eigen::AngleAxisd turn(draw.uniform(0.0, length), vector());
  pose.turn = (Quaternion(turn) * Quaternion(pose.turn)).normalized().toRotationMatrix();
}

/// b beside a, so that they overlap or nearly touch; every second time face on face.
PairPose touching_pose(Draw& draw, const ConvexShape& a, const ConvexShape& b, bool on_face) {
  PairPose pose = testing::random_pose(draw, 1.0, 1.0);
  pose.scale_a = pose.scale_b = 1.0;
  Vector n = pose.centre.normalized();
  if (on_face) {
    n = a.faces[draw.below(a.faces.size())].normal;
    const Vector other = -b.faces[draw.below(b.faces.size())].normal;
    pose.turn = Quaternion::FromTwoVectors(other, n).toRotationMatrix();
  }
  const double reach = reach_along(a, n) + reach_along(b, -(pose.turn.transpose() * n));
  pose.centre = (reach + draw.uniform(-0.05, 0.02)) * n;
  return pose;
}

TEST_CASE("hulls that move have the axes of a search that remembers nothing") {
  Draw draw(9);
  AxisColumns columns;
  int steps = 0, listed = 0;
  for (const ConvexShape& a : shapes()) {
    for (const ConvexShape& b : shapes()) {
      for (const double length : {1e-5, 1e-3, 1e-2}) {
        for (const bool on_face : {false, true}) {
          PairPose pose = touching_pose(draw, a, b, on_face);
          AxisCandidates candidates;
          Vector guess = Vector::Zero();
          for (int step = 0; step < 40; ++step) {
            const ShapePair pair{a, b, pose};
            ++steps;
            listed += candidates.is_listed ? 1 : 0;
            const ContactAxes found = separating_axes(pair, guess, candidates, columns);
            const ContactAxes wanted = separating_axes(pair, testing::kernels().hull);
            // Rounding decides among axes that are equally good.
            REQUIRE(found.face.separation == about(wanted.face.separation, 1e-14));
            REQUIRE(found.separation() == about(wanted.separation(), 1e-13));
            REQUIRE(separation_along(pair, found.best().normal) ==
                    about(found.separation(), 1e-13));
            guess = found.best().normal;
            move(draw, length, pose);
          }
        }
      }
    }
  }
  // Nearly all at the shortest steps but those face on face; none at the longest ones.
  CHECK(listed > steps / 4);
}

TEST_CASE("hulls that jump away and back are not taken for what they were") {
  const ConvexShape cube = testing::cube();
  AxisColumns columns;
  AxisCandidates candidates;
  PairPose on_top;  // a corner on a face
  on_top.turn = Eigen::AngleAxisd(0.6, Vector(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  PairPose beside = on_top;
  const auto distance = [&](const Vector& n) {
    return reach_along(cube, n) + reach_along(cube, -(on_top.turn.transpose() * n)) - 0.01;
  };
  on_top.centre = distance(Vector::UnitZ()) * Vector::UnitZ();
  beside.centre = distance(Vector::UnitX()) * Vector::UnitX();
  const auto axis = [&](const PairPose& pose) {
    return separating_axes({cube, cube, pose}, Vector::Zero(), candidates, columns).face.normal;
  };
  for (int k = 0; k < 3; ++k) CHECK((axis(on_top) - Vector::UnitZ()).norm() < 1e-12);
  CHECK(candidates.is_listed);
  for (int k = 0; k < 3; ++k) CHECK((axis(beside) - Vector::UnitX()).norm() < 1e-12);
  CHECK((axis(on_top) - Vector::UnitZ()).norm() < 1e-12);
}

TEST_CASE("more candidates than have room are searched for each time") {
  const ConvexShape prism = testing::prism(32, 0.5);
  AxisColumns columns;
  AxisCandidates candidates;
  PairPose pose;  // cap on cap, so that every edge of one crosses many of the other
  pose.centre = {0.2, 0.1, 0.49};
  for (int k = 0; k < 3; ++k) {
    const ContactAxes found =
        separating_axes({prism, prism, pose}, Vector::Zero(), candidates, columns);
    CHECK(found.separation() == about(-0.01, 1e-14));
  }
  CHECK(candidates.are_too_many);
  CHECK_FALSE(candidates.is_listed);
}

}  // namespace
}  // namespace grainsweep
