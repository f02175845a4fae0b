#include <catch2/catch.hpp>

#include "engine/shape/pose.hpp"

namespace grainsweep {
namespace {

/// Turns x to y, y to z and z to x, with no rounding.
const Quaternion in_turn(0.5, 0.5, 0.5, 0.5);

TEST_CASE("a point of a shape is scaled, turned, then moved to where it lies in the box") {
  const Pose pose{{10, 20, 30}, 2.0, in_turn};
  CHECK(pose.place({1, 2, 3}) == Vector(16, 22, 34));
  CHECK(pose.place(Vector::Zero()) == pose.centre);
}

}  // namespace
}  // namespace grainsweep
