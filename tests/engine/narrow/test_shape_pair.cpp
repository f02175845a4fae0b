#include <catch2/catch.hpp>

#include "engine/narrow/shape_pair.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

TEST_CASE("either grain of a pair is where the other one sees it") {
  const ConvexShape a = testing::cube(), b = testing::tetrahedron();
  Matrix turn;  // x of b is y of a; all numbers here are exact
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const ShapePair pair{a, b, {{4, 2, 1}, turn, 2.0, 0.5}};
  const SeenShape seen_b = pair.b_from_a(), seen_a = pair.a_from_b();
  for (std::int32_t k = 0; k < 4; ++k) CHECK(seen_b.place(k) == pair.vertex_b(k));
  CHECK(seen_a.centre == Vector(-2, 4, -1));
  for (std::int32_t k = 0; k < 8; ++k) {
    CHECK(pair.pose.centre + turn * seen_a.place(k) == pair.vertex_a(k));
  }
}

}  // namespace
}  // namespace grainsweep
