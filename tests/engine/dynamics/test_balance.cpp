#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/balance.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"

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
  CHECK(std::isnan(balance.unbalance_max));
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

}  // namespace
}  // namespace grainsweep
