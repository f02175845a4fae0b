#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/balance.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::ContactName;
using testing::kernels;
using testing::periodic;
using testing::wall_name;
using testing::walls;

constexpr double step_time = 0.5;
constexpr double rounding = 1e-12;  // a few hundred roundings of numbers near 1

/// Balance of a bed in which the named contacts push; how hard they push must not matter.
ForceBalance balance_of(SphereBed bed, const std::vector<ContactName>& pushing) {
  auto contacts = testing::contacts_of<double>(bed, 0.01, kernels());
  for (const ContactName& name : pushing) {
    testing::set_impulses(bed, {{name, 0.3}}, contacts);
  }
  return balance_forces(bed, kernels(), step_time, contacts);
}

TEST_CASE("the contacts of a column carry it in one way, the uppermost one grain's weight") {
  const SphereBed bed = testing::column_bed(5, 0.0);
  const ForceBalance balance =
      balance_of(bed, {{0, wall_name(bed, 0)}, {0, 1}, {1, 2}, {2, 3}, {3, 4}});
  CHECK(balance.unique);
  CHECK(std::abs(balance.least_force - 1.0) < rounding);
  CHECK(balance.unbalance_max < rounding);
}

TEST_CASE("a sphere between two walls can be squeezed by any force: not unique") {
  const SphereBed bed = make_bed({6, 1, periodic, walls}, {{2, 0.5, 0.5, 0.5}});
  const ForceBalance balance =
      balance_of(bed, {{0, wall_name(bed, 0)}, {0, wall_name(bed, 1)}, {0, wall_name(bed, 2)}});
  CHECK_FALSE(balance.unique);
  CHECK(std::isnan(balance.least_force));
  CHECK(balance.unbalance_max < 1e-7);  // the floor carries it, whatever the walls do
}

TEST_CASE("a sphere that no contact holds misses balance by its own weight") {
  const SphereBed bed = make_bed({6, 4, periodic, walls}, {{2, 0.5, 3.0, 0.4}});
  CHECK(std::abs(balance_of(bed, {}).unbalance_max - 1.0) < rounding);
}

TEST_CASE("a sphere on the shoulder of another slides off: what is missing is reported") {
  // The contact rises by 60 degrees. It carries sin 60 of the weight along its normal at best, and
  // cos 60 is left across it; the lower sphere is held by the floor and a wall.
  const double rise = std::sqrt(3.0) / 2.0;
  const SphereBed bed =
      make_bed({6, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {1.0, 0.5, 0.5 + rise, 0.5}});
  const ForceBalance balance =
      balance_of(bed, {{0, wall_name(bed, 0)}, {0, wall_name(bed, 1)}, {0, 1}});
  CHECK(balance.unique);
  CHECK(std::abs(balance.unbalance_max - 0.5) < rounding);
  CHECK(std::abs(balance.unbalance_mean - 0.25) < rounding);
}

/// Balance of a bed of cubes after a well-solved step from rest.
ForceBalance balance_of_cubes(const std::vector<Pose>& poses) {
  PolyhedronBed bed = make_bed({6, 6, periodic, walls}, testing::cube(), poses);
  StepState<Polyhedron, double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  return balance_forces(bed, kernels(), settings.dt, state.contacts);
}

TEST_CASE("the faces of a stack of cubes carry it in one way, the uppermost one cube's weight") {
  const ForceBalance balance = balance_of_cubes(
      {testing::pose_at(3, 3, 0.5), testing::pose_at(3.1, 3, 1.5), testing::pose_at(3, 3, 2.5)});
  CHECK(balance.unique);
  CHECK(balance.least_force == Approx(1.0).margin(1e-6));  // gaps are closed to the residual
  CHECK(balance.unbalance_max < 1e-6);
}

TEST_CASE("a cube in the air misses balance by its own weight, whatever its size") {
  const ForceBalance balance =
      balance_of_cubes({testing::pose_at(3, 3, 0.25, Quaternion::Identity(), 0.5),
                        testing::pose_at(1, 3, 4.0, Quaternion::Identity(), 0.5)});
  CHECK(balance.unbalance_max == Approx(1.0));
  CHECK(balance.unbalance_mean == Approx(0.5).margin(1e-6));
}

}  // namespace
}  // namespace grainsweep
