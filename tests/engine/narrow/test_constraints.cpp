#include <vector>

#include <catch2/catch.hpp>

#include "engine/narrow/constraints.hpp"

namespace grainsweep {
namespace {

int constraints(const std::vector<ContactPoint>& points, double tolerance = 1e-4) {
  return constraints_of(points.data(), points.size(), tolerance);
}

TEST_CASE("a point is one constraint, a line two, an area three") {
  const Vector o(0.3, 0.2, 0.1), x(0.5, 0, 0), y(0, 0.25, 0);
  CHECK(constraints({}) == 0);
  CHECK(constraints({{o, 0}}) == 1);
  CHECK(constraints({{o, 0}, {o + x, 0}}) == 2);
  CHECK(constraints({{o, 0}, {o + x, 0}, {o + x / 3, 0}}) == 2);
  CHECK(constraints({{o, 0}, {o + x, 0}, {o + y, 0}}) == 3);
  CHECK(constraints({{o, 0}, {o + x, 0}, {o + y, 0}, {o + x + y, 0}}) == 3);
  CHECK(constraints({{o, 0}, {o, 0}, {o + Vector(1e-8, 0, 0), 0}}) == 1);
}

TEST_CASE("only points below the tolerance constrain") {
  const Vector o(0, 0, 0), x(0.5, 0, 0), y(0, 0.25, 0);
  const std::vector<ContactPoint> points = {{o, 1e-3}, {o + x, -1e-3}, {o + y, 1e-5}};
  CHECK(constraints(points, 1e-2) == 3);
  CHECK(constraints(points, 1e-4) == 2);
  CHECK(constraints(points, 0) == 1);
  CHECK(constraints(points, -1) == 0);
  CHECK(constraints(points, 1e-5) == 1);  // one at the tolerance does not
}

}  // namespace
}  // namespace grainsweep
