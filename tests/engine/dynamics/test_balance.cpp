#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/dynamics/balance.hpp"
#include "engine/dynamics/settle.hpp"
#include "tests/support/about.hpp"
#include "tests/support/dense_solver.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::walls;

constexpr double touching = 1e-4;  // d
constexpr double whatever_it_is = std::numeric_limits<double>::infinity();
// Rows are solved to 2e-4 weights of their lighter grain; a grain here has three at most.
constexpr double solved_to = 1e-3;

/// Imbalance of a bed whose forces nobody knows yet.
template <class Kind>
Imbalance imbalance_of(const Bed<Kind>& bed) {
  StepState<Kind, double> closed;
  return static_imbalance(touching, whatever_it_is, kernels(), bed, 1.0, Contacts<Kind, float>{},
                          closed);
}

TEST_CASE("a column that touches carries itself") {
  const Imbalance left = imbalance_of(testing::column_bed(5, 0.0));
  CHECK(left.max < solved_to);
  CHECK(left.mean <= left.max);
}

TEST_CASE("a sphere that walls may squeeze by any force is in balance on the floor") {
  CHECK(imbalance_of(make_bed({6, 1, periodic, walls}, {{2, 0.5, 0.5, 0.5}})).max < solved_to);
}

TEST_CASE("a sphere that no contact holds misses balance by its own weight") {
  const Imbalance left =
      imbalance_of(make_bed({6, 4, periodic, walls}, {{2, 0.5, 3.0, 0.4}, {4, 0.5, 0.5, 0.5}}));
  CHECK(left.max == Approx(1.0));
  CHECK(left.mean == about(0.5, solved_to));
}

TEST_CASE("a bed of which much stands on nothing is known to miss balance by that much at least") {
  // Of a column of four the upper two have lifted off; a wall pushes them aside, not up.
  const SphereBed bed =
      make_bed({6, 1, periodic, walls},
               {{2, 0.5, 0.5, 0.5}, {2, 0.5, 1.5, 0.5}, {2, 0.5, 2.6, 0.5}, {2, 0.5, 3.6, 0.5}});
  StepState<Sphere, double> closed;
  for (const double of_interest : {0.4, 0.6, whatever_it_is}) {
    const Imbalance left = static_imbalance(touching, of_interest, kernels(), bed, 1.0,
                                            SphereContacts<float>{}, closed);
    CHECK(left.mean == about(0.5, solved_to));
    CHECK(left.max == about(of_interest < 0.5 ? 0.5 : 1.0, solved_to));
  }
}

TEST_CASE("light grains that stand on nothing count by their mass") {
  // An eighth of the mass of each of two others: what falls is a sixteenth of them, of three grains
  // a 24th.
  const SphereBed bed =
      make_bed({6, 4, periodic, walls}, {{2, 2, 3.0, 0.25}, {1, 2, 0.5, 0.5}, {4, 2, 0.5, 0.5}});
  StepState<Sphere, double> closed;
  const Imbalance left =
      static_imbalance(touching, 0.04, kernels(), bed, 1.0, SphereContacts<float>{}, closed);
  CHECK(left.mean == Approx(1.0 / 24.0).epsilon(1e-12));
}

TEST_CASE("heavy grains that stand on nothing miss balance by their own weight, however heavy") {
  const SphereBed bed = make_bed({8, 4, periodic, walls}, {{2, 2, 3, 1}, {6, 2, 0.5, 0.5}});
  StepState<Sphere, double> closed;
  const Imbalance left =
      static_imbalance(touching, 0.04, kernels(), bed, 1.0, SphereContacts<float>{}, closed);
  CHECK(left.mean == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("a bed without grains has no imbalance") {
  CHECK(imbalance_of(make_bed({6, 4, periodic, walls}, std::vector<PlacedSphere>{})).max == 0);
}

TEST_CASE("a sphere on the shoulder of another slides off: what is missing is reported") {
  // The contact rises by 60 degrees. It carries sin 60 of the weight along its normal at best, and
  // cos 60 is left across it; the lower sphere is held by the floor and a wall.
  const double rise = std::sqrt(3.0) / 2.0;
  const Imbalance left = imbalance_of(
      make_bed({6, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {1.0, 0.5, 0.5 + rise, 0.5}}));
  CHECK(left.max == about(0.5, solved_to));
  CHECK(left.mean == about(0.25, solved_to));
}

TEST_CASE("a contact that would have to pull holds nothing") {
  // A small sphere hangs 30 degrees below one that stands on another.
  const double aside = 0.7 * std::sqrt(3.0) / 2.0, below = 0.7 / 2.0;
  const Imbalance left = imbalance_of(
      make_bed({6, 4, walls, walls},
               {{0.5, 0.5, 1.5, 0.5}, {0.5 + aside, 0.5, 1.5 - below, 0.2}, {0.5, 0.5, 0.5, 0.5}}));
  CHECK(left.max == Approx(1.0));
  CHECK(left.mean == about(1.0 / 3.0, solved_to));
}

TEST_CASE("contacts count below the tolerance alone, whether they bore a force or not") {
  for (const double gap : {0.9 * touching, 1.1 * touching}) {
    const SphereBed bed = make_bed({6, 4, periodic, walls}, {{2, 2, 0.5 + gap, 0.5}});
    CHECK(imbalance_of(bed).max == about(gap < touching ? 0.0 : 1.0, solved_to));
  }
}

TEST_CASE("overlaps push no harder than what they carry") {
  CHECK(imbalance_of(make_bed({6, 4, periodic, walls}, {{2, 2, 0.4, 0.5}})).max < solved_to);
}

TEST_CASE("a contact across a periodic side holds, and the bed stays where it is") {
  // Four spheres in a periodic row carry a fifth that leans on the last and the first of them.
  const double rise = std::sqrt(3.0) / 2.0;
  const SphereBed bed = make_bed({4, 1, periodic, walls}, {{0.5, 0.5, 0.5, 0.5},
                                                           {1.5, 0.5, 0.5, 0.5},
                                                           {2.5, 0.5, 0.5, 0.5},
                                                           {3.5, 0.5, 0.5, 0.5},
                                                           {8.0, 0.5, 0.5 + rise, 0.5}});
  CHECK(imbalance_of(bed).max < solved_to);
  CHECK(bed.position[4].x == 8.0);
}

TEST_CASE("small grains are judged by their own weight") {
  const Imbalance left =
      imbalance_of(make_bed({6, 4, periodic, walls}, {{2, 2, 3.0, 0.05}, {4, 2, 0.5, 0.5}}));
  CHECK(left.max == Approx(1.0));
}

/// Largest and mean acceleration of the exact solution.
Imbalance exact_imbalance(SphereBed bed) {
  auto contacts = testing::contacts_of<double>(bed, touching, kernels());
  for (RowBlock<double>& row : contacts.rows) {
    for (double& gap : row.gap) gap = gap < touching ? 0.0 : 1e6;
  }
  std::vector<Record<double>> free(bed.position.size(), {0, 0, 0, 0});
  for (std::size_t i = 0; i < bed.grains(); ++i) free[i] = {0, 0, -1, bed.motion[i].w};
  const auto exact = testing::solve_dense(testing::dense_problem(bed, contacts, free));
  Imbalance left;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const auto* u = exact.u.data() + 3 * i;
    const auto size = static_cast<double>(std::hypot(u[0], u[1], u[2]));
    left.max = std::max(left.max, size);
    left.mean += size / static_cast<double>(bed.grains());
  }
  return left;
}

TEST_CASE("the imbalance of a bed is that of a dense reference, whatever forces it starts from") {
  SphereBed bed = testing::random_bed({.box = {4, 4, periodic, walls}, .grains = 60});
  StepState<Sphere, float> state;
  StepSettings settings;
  settings.limits.iterations = 5;
  for (int k = 0; k < 60; ++k) step(settings, kernels(), bed, state);
  const Imbalance exact = exact_imbalance(bed);
  StepState<Sphere, double> closed;
  const Imbalance warm = static_imbalance(touching, whatever_it_is, kernels(), bed, settings.dt,
                                          state.contacts, closed);
  REQUIRE(exact.max > 0.1);  // most of its contacts are still open
  for (const Imbalance& left : {imbalance_of(bed), warm}) {
    CHECK(left.mean == Approx(exact.mean).epsilon(0.03));  // errors of rows add up
    CHECK(left.max == Approx(exact.max).epsilon(0.03));
  }
}

/// Cubes stand on the floor and on each other, 5e-5 d apart so that they touch.
PolyhedronBed bed_of_cubes(const std::vector<Pose>& poses) {
  return testing::shape_bed({6, 6, periodic, walls}, testing::cube(), poses);
}

TEST_CASE("the faces of a stack of cubes carry it") {
  const double up = 5e-5;
  CHECK(imbalance_of(
            bed_of_cubes({testing::pose_at(3, 3, 0.5 + up), testing::pose_at(3.1, 3, 1.5 + 2 * up),
                          testing::pose_at(3, 3, 2.5 + 3 * up)}))
            .max < 10.0 * solved_to);  // four points a face
}

TEST_CASE("a cube whose centre lies beyond the edge it stands on tips over") {
  // Nothing pushes it sideways, so its centre falls: where the edge bears it, .1 aside of the
  // centre, f - 1 + .1 (.1 f) / (1/6) = 0. What is left is the torque .1 f over the circumradius.
  const double force = 1.0 / (1.0 + 0.1 * 0.1 * 6.0), circumradius = std::sqrt(3.0) / 2.0;
  const Imbalance left =
      imbalance_of(bed_of_cubes({testing::pose_at(3, 3, 0.5), testing::pose_at(3.6, 3, 1.5)}));
  CHECK(left.max == about(0.1 * force / circumradius, solved_to));
}

TEST_CASE("a cube in the air misses balance by its own weight, whatever its size") {
  const Imbalance left =
      imbalance_of(bed_of_cubes({testing::pose_at(3, 3, 0.25, Quaternion::Identity(), 0.5),
                                 testing::pose_at(1, 3, 4.0, Quaternion::Identity(), 0.5)}));
  CHECK(left.max == Approx(1.0));
  CHECK(left.mean == about(0.5, solved_to));
}

}  // namespace
}  // namespace grainsweep
