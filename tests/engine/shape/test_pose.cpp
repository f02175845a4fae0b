#include <catch2/catch.hpp>

#include "engine/shape/pose.hpp"

namespace grainsweep {
namespace {

/// Turns x to y, y to z and z to x, with no rounding.
const Quaternion in_turn(0.5, 0.5, 0.5, 0.5);

TEST_CASE("a record's first three numbers are a vector, a pose both of a grain's records") {
  CHECK(vector_of(Record<float>{0.5F, -2, 3, 7}) == Vector(0.5, -2, 3));
  const Pose pose = pose_of({1, 2, 3, 0.25}, {0.5, 0.5, 0.5, -0.5});
  CHECK(pose.centre == Vector(1, 2, 3));
  CHECK(pose.scale == 0.5);
  CHECK(pose.orientation.coeffs() == Eigen::Vector4d(0.5, 0.5, 0.5, -0.5));
}

TEST_CASE("a point of a shape is scaled, turned, then moved to where it lies in the box") {
  const Pose pose{{10, 20, 30}, 2.0, in_turn};
  CHECK(pose.place({1, 2, 3}) == Vector(16, 22, 34));
  CHECK(pose.place(Vector::Zero()) == pose.centre);
}

}  // namespace
}  // namespace grainsweep
