#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/rows/travel.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

TEST_CASE("no point of a grain comes further than its travel, and hardly less far than that") {
  PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, walls}, testing::cube(), 40, 4, 1);
  testing::Draw draw(2);
  Travel travel;
  add_travel(bed, serial_for, travel);
  const auto corner = [&](std::size_t i, std::size_t v) -> Vector {
    return bed.scale(i) * (bed.pose(i).orientation * bed.shape(i).vertices[v]);
  };
  std::vector<double> way(bed.grains(), 0.0);
  for (int k = 0; k < 60; ++k) {
    const double turn = k < 30 ? 0.01 : 3.0;
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      std::vector<Vector> before;
      for (std::size_t v = 0; v < 8; ++v) before.push_back(corner(i, v));
      const Vector step = 0.3 * testing::random_direction(draw);
      move_grain(bed, i, step, turn * testing::random_direction(draw));
      Record<double>& q = bed.orientation[i];
      if (k % 2 == 1) q = {-q.x, -q.y, -q.z, -q.w};  // the same orientation
      double farthest = 0.0;
      for (std::size_t v = 0; v < 8; ++v) {
        farthest = std::max(farthest, (corner(i, v) - before[v] + step).norm());
      }
      way[i] += farthest;
    }
    wrap(bed);
    const std::vector<double> so_far = travel.way;
    add_travel(bed, serial_for, travel);
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      // A point at the circumradius that turns about an axis across it, moved the way it turns.
      const double most = 0.3 + 2.0 * std::sin(turn / 2.0) * bed.circumradius(i);
      REQUIRE(travel.way[i] >= way[i]);
      REQUIRE(travel.way[i] - so_far[i] >= most - 1e-12);
      REQUIRE(travel.way[i] - so_far[i] <= 0.3 + (most - 0.3) / std::cos(turn / 4.0) + 1e-12);
    }
  }
}

TEST_CASE("grains that stay where they are have no travel, wherever they are wrapped") {
  PolyhedronBed bed = testing::random_shape_bed({6, 5, periodic, walls}, testing::cube(), 20, 4, 3);
  Travel travel;
  add_travel(bed, serial_for, travel);
  for (std::size_t i = 0; i < bed.grains(); ++i) bed.position[i].x += i % 2 == 0 ? 6.0 : -6.0;
  add_travel(bed, serial_for, travel);
  for (const double way : travel.way) CHECK(way < 1e-14);  // 6 - 6 to rounding
}

}  // namespace
}  // namespace grainsweep
