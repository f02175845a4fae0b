#include <catch2/catch.hpp>

#include "runner/export/necks.hpp"

namespace grainsweep {
namespace {

std::vector<Vector> cube_at(const Vector& centre) {
  std::vector<Vector> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back(centre + Vector(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5));
  }
  return corners;
}

TEST_CASE("convex hulls are apart by no more than they are") {
  const auto cube = cube_at({0, 0, 0});
  CHECK(are_apart(cube, cube_at({1.5, 0.3, 0.2}), 0.49));
  CHECK_FALSE(are_apart(cube, cube_at({1.5, 0.3, 0.2}), 0.51));
  CHECK_FALSE(are_apart(cube, cube_at({0.9, 0.9, 0.9}), 0.0));
  CHECK(are_apart(cube, {{1.5, 1.5, 0.5}}, 1.41));
  CHECK_FALSE(are_apart(cube, {{1.5, 1.5, 0.5}}, 1.42));
}

TEST_CASE("corners of a neck lie on a circle about its axis, counter-clockwise") {
  Neck neck;
  neck.radius = 0.2;
  neck.middle = {1, 0, 0};
  CHECK((neck_corner(neck, 0, 3) - Vector(1.2, 0, 3)).norm() < 1e-15);
  CHECK((neck_corner(neck, neck_sides / 4, 3) - Vector(1, 0.2, 3)).norm() < 1e-15);
}

}  // namespace
}  // namespace grainsweep
