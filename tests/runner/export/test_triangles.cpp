#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "engine/shape/build.hpp"
#include "engine/units.hpp"
#include "runner/export/triangles.hpp"

namespace grainsweep {
namespace {

using Eigen::Vector3d;

/// Appends a polygon of that many corners; clockwise of a negative radius.
Loop ring(std::vector<Vector3d>& corners, const Vector3d& centre, double radius, int count) {
  Loop loop;
  for (int k = 0; k < count; ++k) {
    const double angle = (radius > 0 ? 2 : -2) * pi * k / count;
    loop.push_back(static_cast<std::int32_t>(corners.size()));
    corners.emplace_back(centre + std::abs(radius) * Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return loop;
}

double area(const std::vector<Vector3d>& corners, const std::vector<Loop>& loops) {
  double sum = 0.0;
  for (const Loop& loop : loops) sum += area_vector(corners, loop).z();
  return sum;
}

TEST_CASE("a polygon with holes in a row is filled by triangles that all face its way") {
  std::vector<Vector3d> corners;
  std::vector<Loop> loops = {ring(corners, {0, 0, 0}, 4, 5)};
  for (const double x : {-1.5, 0.0, 1.5}) loops.push_back(ring(corners, {x, 0, 0}, -0.7, 12));
  loops.push_back(ring(corners, {0, 1.6, 0}, -0.7, 12));
  const auto triangles = triangles_of(corners, Vector3d::UnitZ(), loops);
  CHECK(triangles.size() == 5 + 4 * 12 + 2 * 4 - 2);
  for (const Loop& triangle : triangles) CHECK(area_vector(corners, triangle).z() > 0);
  CHECK(area(corners, triangles) == Approx(area(corners, loops)).epsilon(1e-12));
}

TEST_CASE("corners in line make no flat triangle, and two regions are filled at once") {
  std::vector<Vector3d> corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0},
                                   {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}};
  const auto triangles = triangles_of(corners, Vector3d::UnitZ(), {{0, 1, 2, 3, 4, 5}, {6, 7, 8}});
  CHECK(triangles.size() == 5);
  for (const Loop& triangle : triangles) {
    CHECK(area_vector(corners, triangle).z() == Approx(0.5).epsilon(1e-14));
  }
}

TEST_CASE("loops that cross themselves are refused") {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {0, 1, 0}};
  CHECK_THROWS_AS(triangles_of(corners, Vector3d::UnitZ(), {{0, 2, 3, 1}}), std::logic_error);
}

}  // namespace
}  // namespace grainsweep
