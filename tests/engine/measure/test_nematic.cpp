#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/measure/nematic.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

TEST_CASE("parallel axes have order one, whatever their signs") {
  const Vector u = Vector(1, 2, -2) / 3;
  CHECK(nematic_order({u, -u, u, u, -u}) == Approx(1).epsilon(1e-15));
}

TEST_CASE("axes along x, y and z alike have order zero, all around in a plane a quarter") {
  const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();
  CHECK(nematic_order({x, y, z}) == Approx(0).margin(1e-15));
  CHECK(nematic_order({x, y}) == Approx(0.25).epsilon(1e-15));
  CHECK(nematic_order({x, x, x, y}) == Approx(1.5 * 0.75 - 0.5).epsilon(1e-15));
  CHECK(std::isnan(nematic_order({})));
}

TEST_CASE("no rotation changes the order") {
  testing::Draw draw(4);
  std::vector<Vector> axes, turned;
  for (int k = 0; k < 30; ++k)
    axes.push_back((testing::random_direction(draw) + Vector(0, 0, 2)).normalized());
  const Quaternion turn = testing::random_rotation(draw);
  for (const Vector& axis : axes) turned.push_back(turn * axis);
  CHECK(nematic_order(turned) == Approx(nematic_order(axes)).epsilon(1e-13));
}

// The order of n random axes is of the size of its noise, 1 / sqrt(n).
TEST_CASE("random axes have hardly any order") {
  testing::Draw draw(5);
  std::vector<Vector> axes;
  for (int k = 0; k < 10000; ++k) axes.push_back(testing::random_direction(draw));
  const double order = nematic_order(axes);
  CHECK((order > 0 && order < 3 / std::sqrt(10000.0)));
}

}  // namespace
}  // namespace grainsweep
