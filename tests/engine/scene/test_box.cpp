#include <cmath>

#include <catch2/catch.hpp>

#include "engine/scene/box.hpp"

namespace grainsweep {
namespace {

bool points_along(const UnitVector& n, double x, double y, double z) {
  return n.x == x && n.y == y && n.z == z;
}

TEST_CASE("the floor comes first, then a wall on either side of each walled axis") {
  const auto of_x_periodic = walls_of({8, 5, Boundary::periodic, Boundary::walls});
  REQUIRE(of_x_periodic.size() == 3);
  CHECK(points_along(of_x_periodic[0].inward, 0, 0, 1));
  CHECK(points_along(of_x_periodic[1].inward, 0, 1, 0));
  CHECK(points_along(of_x_periodic[2].inward, 0, -1, 0));
  CHECK(walls_of({8, 5, Boundary::periodic, Boundary::periodic}).size() == 1);
  CHECK(walls_of({8, 5, Boundary::walls, Boundary::walls}).size() == 5);
}

TEST_CASE("the gap of a wall is the distance of the sphere's surface from it") {
  const Record<double> sphere{1, 2, 3, 0.5};
  const double expected[] = {2.5, 0.5, 6.5, 1.5, 2.5};  // floor, x = 0, x = 8, y = 0, y = 5
  const auto all = walls_of({8, 5, Boundary::walls, Boundary::walls});
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK(all[k].gap(sphere) == expected[k]);
  }
}

TEST_CASE("the gap of a tilted wall grows by a step along its normal") {
  const double tilt = 0.3;
  const Wall wall{{std::sin(tilt), 0.0, std::cos(tilt)}, -0.2};
  const UnitVector n = wall.normal(1, 2, 3);
  const double before = wall.distance(1, 2, 3);
  CHECK(wall.distance(1 + 0.25 * n.x, 2 + 0.25 * n.y, 3 + 0.25 * n.z) == Approx(before + 0.25));
  CHECK(wall.distance(0, 7, 0) == Approx(-0.2));
}

TEST_CASE("a tube has a floor and one round wall, whose gap and normal depend on the place") {
  const Box tube = tube_of(6);
  CHECK(tube.floor_area() == Approx(9 * pi));
  CHECK((tube.period_x() == 0 && tube.period_y() == 0));
  const auto all = walls_of(tube);
  REQUIRE(all.size() == 2);
  const Wall& round = all[1];
  REQUIRE(round.is_round());
  CHECK(round.gap({3, 3, 1, 0.5}) == 2.5);
  CHECK(round.gap({3, 0.25, 1, 0.5}) == -0.25);
  CHECK(points_along(round.normal(3, 5, 1), 0, -1, 0));
  CHECK(points_along(round.normal(1, 3, 1), 1, 0, 0));
  CHECK(points_along(round.normal(3, 3, 1), 1, 0, 0));  // on the axis: towards x
  const UnitVector n = round.normal(4, 4, 7);
  CHECK(round.distance(4 + 0.1 * n.x, 4 + 0.1 * n.y, 7) == Approx(round.distance(4, 4, 7) + 0.1));
}

TEST_CASE("the nearest image of a difference is at most half a period away, on either side") {
  for (const double difference : {-14.0, -9.5, -5.5, -4.5, 0.0, 4.5, 5.5, 9.5, 14.0}) {
    const double near = nearest_image(difference, 10.0);
    CHECK(std::abs(near) <= 5.0);
    CHECK(std::remainder(near - difference, 10.0) == Approx(0.0).margin(1e-12));
    CHECK(nearest_image(difference, 0.0) == difference);
  }
}

}  // namespace
}  // namespace grainsweep
