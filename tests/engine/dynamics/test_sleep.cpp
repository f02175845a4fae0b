#include <catch2/catch.hpp>

#include "engine/dynamics/sleep.hpp"
#include "engine/dynamics/step.hpp"
#include "tests/support/about.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::walls;

constexpr double step_length = 0.2;

/// Grains exactly above each other, 1 d apart; those from `falling` up move down by 0.15 d a step.
SphereBed column(int grains, int falling) {
  SphereBed bed = testing::column_bed(grains, 0.0);
  for (int i = falling; i < grains; ++i) bed.motion[static_cast<std::size_t>(i)].z = -0.15;
  return bed;
}

TEST_CASE("grains sleep that lie deeper below the filling front than the depth of sleep") {
  SphereBed bed = column(100, 65);
  CHECK(put_to_sleep(step_length, bed));
  for (std::size_t i = 0; i < 100; ++i) {
    CHECK(bed.is_asleep(i) == (bed.position[i].z < 65.0 - sleep_depth));
  }
  CHECK(bed.first_awake == 25);
  CHECK_FALSE(put_to_sleep(step_length, bed));  // again: none is new
  CHECK(wake(bed));
  CHECK_FALSE(wake(bed));
  CHECK_FALSE(bed.is_asleep(0));
  CHECK(bed.first_awake == 0);
}

TEST_CASE("nothing sleeps in a bed that does not fill up") {
  SphereBed at_rest = column(60, 60), falling = column(60, 0);
  CHECK_FALSE(put_to_sleep(step_length, at_rest));
  CHECK_FALSE(put_to_sleep(step_length, falling));
}

TEST_CASE("a bed whose small grains may slip through the large ones does not sleep") {
  const Box box{6, 6, periodic, walls};
  CHECK(may_sleep(make_bed(box, {{1, 1, 1, 0.5}, {3, 3, 1, 0.25}})));
  CHECK_FALSE(may_sleep(make_bed(box, {{1, 1, 1, 0.5}, {3, 3, 1, 0.15}})));
  CHECK(may_sleep(make_bed(box, {{1, 1, 1, 0.5}, {3, 3, 1, 0.2}})));  // just the size
  CHECK(may_sleep(make_bed(box, {})));
  const auto mixture = [&](double edge) {  // of cubes of one scale
    return make_bed(box, {testing::cube(), testing::box_shape(edge, edge, edge)}, {0, 1},
                    {testing::pose_at(1, 1, 1), testing::pose_at(3, 3, 1)});
  };
  CHECK(may_sleep(mixture(0.5)));
  CHECK_FALSE(may_sleep(mixture(0.3)));
}

TEST_CASE("what sleeps is neither searched among itself nor with walls") {
  SphereBed bed = testing::random_bed({{8, 5, periodic, walls}, 600, 0.3, 0.5, 14, 3});
  wrap(bed);
  bed.asleep.assign(bed.grains(), 0);
  for (std::size_t i = 0; i < bed.grains(); ++i) bed.asleep[i] = bed.position[i].z < 7.0 ? 1 : 0;
  Candidates candidates;
  constexpr double reach = 0.13;
  find_candidates({bed, bed.position}, reach, kernels_for(best_isa()), candidates);
  const auto listed = testing::listed_pairs(candidates);
  std::size_t expected = 0;
  for (std::size_t a = 0; a < bed.grains(); ++a) {
    for (std::size_t b = a + 1; b < bed.grains(); ++b) {
      const auto one = static_cast<std::int32_t>(a), other = static_cast<std::int32_t>(b);
      const double gap = testing::gap_of(bed, one, other);
      const bool both_sleep = bed.is_asleep(a) && bed.is_asleep(b);
      const bool is_listed = listed.count({one, other}) == 1;
      if (both_sleep) CHECK_FALSE(is_listed);
      if (!both_sleep && gap < reach) CHECK(is_listed);
      expected += is_listed ? 1 : 0;
    }
  }
  CHECK(expected == listed.size());
  CHECK(expected > 300);
  for (const std::vector<std::int32_t>& near : candidates.walls) {
    for (const std::int32_t grain : near) {
      CHECK_FALSE(bed.is_asleep(static_cast<std::size_t>(grain)));
    }
  }
}

// The heap above them bears on them as on a floor.
TEMPLATE_TEST_CASE("grains that sleep stand still and carry those above", "", float, double) {
  SphereBed bed = testing::column_bed(6, 0.0);
  bed.asleep = {1, 1, 1, 0, 0, 0};
  bed.first_awake = 3;
  bed.motion[1].x = bed.motion[4].x = 0.1;  // of one that just fell asleep, and of one awake
  const SphereBed before = bed;
  StepState<Sphere, TestType> state;
  StepSettings settings;
  settings.dt = step_length;
  settings.momentum = 1.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-5};
  const StepReport report = step(settings, kernels(), bed, state);
  CHECK(bed.motion[1].x == 0.0);
  // Of one in three that are awake.
  CHECK(report.kinetic_energy == Approx(0.1 * 0.1 / (2 * step_length * step_length) / 3));
  CHECK(report.carried == Approx(1.0).epsilon(1e-4));  // of three grains, by a residual of 1e-5
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(bed.position[i].z == about(before.position[i].z, 1e-5));
    if (i < 3) CHECK(bed.position[i].z == before.position[i].z);
  }
  for (const ForceContact& contact : force_contacts(bed, step_length, state.contacts)) {
    CHECK(std::max(contact.a, contact.b) >= 3);
    CHECK(contact.force == Approx(6 - std::max(contact.a, contact.b)).epsilon(1e-3));
  }
}

}  // namespace
}  // namespace grainsweep
