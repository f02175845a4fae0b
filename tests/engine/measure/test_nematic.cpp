#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/measure/nematic.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

TEST_CASE("parallel axes have order one along themselves, whatever their signs") {
  const Vector u = Vector(1, 2, -2) / 3;
  const NematicOrder order = nematic_order({u, -u, u, u, -u});
  CHECK(order.order == Approx(1).epsilon(1e-15));
  CHECK(std::abs(order.director.dot(u)) == Approx(1).epsilon(1e-15));
}

TEST_CASE("axes along x, y and z alike have order zero, all around in a plane a quarter") {
  const Vector x = Vector::UnitX(), y = Vector::UnitY(), z = Vector::UnitZ();
  CHECK(nematic_order({x, y, z}).order == Approx(0).margin(1e-15));
  CHECK(nematic_order({x, y}).order == Approx(0.25).epsilon(1e-15));
  CHECK(nematic_order({x, x, x, y}).order == Approx(1.5 * 0.75 - 0.5).epsilon(1e-15));
  CHECK(std::isnan(nematic_order({}).order));
}

TEST_CASE("no rotation changes the order, and the director turns along") {
  testing::Draw draw(4);
  std::vector<Vector> axes, turned;
  for (int k = 0; k < 30; ++k)
    axes.push_back((testing::random_direction(draw) + Vector(0, 0, 2)).normalized());
  const Quaternion turn = testing::random_rotation(draw);
  for (const Vector& axis : axes) turned.push_back(turn * axis);
  const NematicOrder here = nematic_order(axes), there = nematic_order(turned);
  CHECK(there.order == Approx(here.order).epsilon(1e-13));
  CHECK(std::abs(there.director.dot(turn * here.director)) == Approx(1).epsilon(1e-13));
}

// The order of n random axes is of the size of its noise, 1 / sqrt(n).
TEST_CASE("random axes have hardly any order") {
  testing::Draw draw(5);
  std::vector<Vector> axes;
  for (int k = 0; k < 10000; ++k) axes.push_back(testing::random_direction(draw));
  const double order = nematic_order(axes).order;
  CHECK((order > 0 && order < 3 / std::sqrt(10000.0)));
}

}  // namespace
}  // namespace grainsweep
