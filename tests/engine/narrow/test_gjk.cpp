// Distances by GJK, and separating axes beside them, against brute force in every degenerate
// position. The counts here are those of
// every run; GRAINSWEEP_PAIRS multiplies them: 250 is the full test of 10 million random pairs and
// a million of each other family (some 20 minutes a family).
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "engine/narrow/gjk.hpp"
#include "engine/narrow/separating_axes.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_pairs.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::PairFamily;
using testing::PairTruth;

/// 40,000 random pairs, 4000 of each other family, times GRAINSWEEP_PAIRS.
int pair_count(PairFamily family) {
  const char* factor = std::getenv("GRAINSWEEP_PAIRS");
  return (family == PairFamily::random ? 40000 : 4000) *
         (factor != nullptr ? std::atoi(factor) : 1);
}

// The bounds that this engine promises (f64; the worst of touching edges).
constexpr double gjk_bound = 1e-7, axes_bound = 1e-12;

/// Worst errors of one family.
struct Errors {
  double gjk = 0, axes = 0;
  long overlaps = 0, apart = 0;
};

void check_gjk(const ShapePair& pair, const PairTruth& truth, Errors& errors) {
  const Closest closest = closest_points(pair, testing::kernels().hull);
  REQUIRE(closest.converged);
  REQUIRE(std::isfinite(closest.distance));
  const double error = std::abs(closest.distance - static_cast<double>(truth.distance));
  errors.gjk = std::max(errors.gjk, error);
  REQUIRE(error <= gjk_bound);
  if (!closest.overlap) {
    REQUIRE((closest.on_b - closest.on_a).norm() == about(closest.distance, 1e-14));
  }
  if (truth.overlap != closest.overlap) {
    REQUIRE(std::abs(static_cast<double>(truth.gap())) <= gjk_bound);
  }
}

void check_axes(const ShapePair& pair, const PairTruth& truth, Errors& errors) {
  const ContactAxes axes = separating_axes(pair, testing::kernels().hull);
  const double found = axes.separation();
  REQUIRE(std::isfinite(found));
  const double apart = found - static_cast<double>(truth.gap());
  REQUIRE(apart <= axes_bound);  // never deeper inside than the truth says outside
  // Of hulls apart the axes are normals of their difference: they reach the distance where any axis
  // does, and beside that, between corners, only part the shapes.
  const bool reached =
      pair.a.pinacoid || truth.distance - truth.separation <= 1e-9L * truth.distance;
  const double least = truth.overlap ? static_cast<double>(truth.gap())
                       : reached     ? static_cast<double>(truth.separation)
                                     : 0.0;
  const double shallow = least - found;
  errors.axes = std::max({errors.axes, apart, shallow});
  REQUIRE(shallow <= axes_bound);
  (truth.overlap ? errors.overlaps : errors.apart) += 1;
}

void check_pair(const ShapePair& pair, Errors& errors) {
  const PairTruth truth = testing::true_gap(pair);
  check_gjk(pair, truth, errors);
  check_axes(pair, truth, errors);
}

Errors check_family(PairFamily family, const ConvexShape& a, const ConvexShape& b, int count,
                    std::uint64_t seed) {
  Draw draw(seed);
  Errors errors;
  for (int k = 0; k < count; ++k) {
    INFO(testing::name_of(family) << ", pair " << k);
    check_pair({a, b, testing::pose_of_family(family, draw, a, b)}, errors);
  }
  if (std::getenv("GRAINSWEEP_PAIRS") != nullptr) {
    WARN(testing::name_of(family) << ": " << count << " pairs, " << errors.overlaps
                                  << " overlap; worst error of GJK " << errors.gjk
                                  << " d, of the axes " << errors.axes << " d");
  }
  CHECK(errors.overlaps + errors.apart == count);
  return errors;
}

TEST_CASE("distance and depth of pinacoids are those of brute force, in every position", "[slow]") {
  const ConvexShape shape = pinacoid({}), plate = pinacoid({1, 1, 0.01, 0.3});
  for (const PairFamily family : testing::all_pair_families) {
    const ConvexShape& used = family == PairFamily::flat ? plate : shape;
    const Errors errors =
        check_family(family, used, used, pair_count(family), 100 + static_cast<int>(family));
    CHECK((errors.overlaps > 0 || family == PairFamily::flat));
    CHECK((errors.apart > 0 || family == PairFamily::deep_overlap));
  }
}

TEST_CASE("distance and depth of hulls are those of brute force, in every position", "[slow]") {
  Draw draw(5);
  for (const PairFamily family : testing::all_pair_families) {
    const ConvexShape a = testing::hull_of(testing::random_corners(draw, 9));
    const ConvexShape b = testing::hull_of(testing::random_corners(draw, 14));
    check_family(family, a, b, pair_count(family) / 20, 200 + static_cast<int>(family));
    const ConvexShape cube = testing::cube(), tetrahedron = testing::tetrahedron();
    check_family(family, cube, tetrahedron, pair_count(family) / 20, 300);
    check_family(family, cube, cube, pair_count(family) / 20, 400);
  }
}

// No plane between the shapes can lie further from both than they are apart, and no two of their
// points nearer to each other: where both bounds meet, they are the distance.
TEST_CASE("the plane across the shortest line between shapes of many corners proves that it is") {
  Draw draw(31);
  int apart = 0;
  for (int k = 0; k < 300; ++k) {
    const ConvexShape a = testing::hull_of(testing::random_corners(draw, 60));
    const ConvexShape b = testing::hull_of(testing::random_corners(draw, 40));
    const ShapePair pair{a, b, testing::pose_of_family(PairFamily::random, draw, a, b)};
    const Closest closest = closest_points(pair, testing::kernels().hull);
    if (closest.overlap) continue;
    ++apart;
    const Vector between = closest.on_b - closest.on_a;
    const double parted = separation_along(pair, between.normalized());
    CHECK(between.norm() - parted == Approx(0).margin(1e-12));  // rounding of corners
  }
  CHECK(apart > 50);
}

// Found by the full counts: a sliver of corners 3e-12 d from the origin, in a direction that parts
// nothing.
TEST_CASE("cubes nearly face in face that overlap by 6.5e-7 d are not taken for parted") {
  const ConvexShape cube = testing::cube();
  PairPose pose{{0x1.db5cf6b520549p-1, 0x1.4705d056b2b7dp-3, -0x1.e5aa4bf6f0d67p-5},
                Matrix::Identity(),
                0x1.e7a0a24e85a9dp-1,
                0x1.cf17c1004a055p-1};
  pose.turn << 0x1.ffffffff80504p-1, -0x1.3ea4f5855c944p-17, 0x1.55dbc654bd58p-18,
      -0x1.0abb215bcb02p-17, -0x1.f03a8343ae78ep-1, -0x1.f86667430f9bcp-3, 0x1.e849081489388p-18,
      0x1.f86667412da1p-3, -0x1.f03a8343d8b82p-1;
  const ShapePair pair{cube, cube, pose};
  CHECK(separating_axes(pair, testing::kernels().hull).separation() == about(-6.51032e-7, 1e-12));
  const Closest closest = closest_points(pair, testing::kernels().hull);
  CHECK(closest.overlap);
  CHECK(closest.distance == 0.0);
}

}  // namespace
}  // namespace grainsweep
