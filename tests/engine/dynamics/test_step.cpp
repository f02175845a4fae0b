#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/step.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/named_contacts.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::ContactName;
using testing::kernels;
using testing::periodic;
using testing::walls;

/// Steps that repair overlaps whole and are solved to 1e-9 m g.
StepSettings tight_steps(double momentum) {
  StepSettings settings;
  settings.momentum = momentum;
  settings.correction = 1.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 100'000, 1e-9};
  return settings;
}

template <class Real>
StepReport take_steps(int steps, const StepSettings& settings, SphereBed& bed,
                      StepState<Sphere, Real>& state) {
  StepReport report;
  for (int k = 0; k < steps; ++k) {
    report = step(settings, kernels(), bed, state);
  }
  return report;
}

/// Force of each contact, m g.
std::map<ContactName, double> forces_of(const SphereBed& bed,
                                        const StepState<Sphere, double>& state, double dt) {
  std::map<ContactName, double> forces = testing::impulses_of(bed, state.contacts);
  for (auto& [name, force] : forces) {
    force /= dt * dt;
  }
  return forces;
}

TEST_CASE("a grain in the air falls as the heavy ball says, up to the longest motion") {
  SphereBed bed = make_bed({4, 4, periodic, walls}, {{2, 2, 50, 0.5}});
  StepState<Sphere, double> state;
  const StepSettings settings = tight_steps(0.9);
  double motion = 0, z = 50;
  for (int k = 0; k < 40; ++k) {
    const StepReport report = step(settings, kernels(), bed, state);
    motion = std::min(0.9 * motion + 0.04, 0.15);
    z -= motion;
    REQUIRE(bed.position[0].z == about(z, 1e-12));
    REQUIRE(report.largest_motion == about(motion, 1e-14));
    REQUIRE(report.kinetic_energy == about(motion * motion / 0.08, 1e-12));
  }
  CHECK(motion == 0.15);
  CHECK(bed.position[0].x == 2);
  CHECK(bed.position[0].y == 2);
}

TEST_CASE("kinetic energy is the mean over the grains of half the mass times velocity squared") {
  SphereBed bed = make_bed({4, 4, periodic, walls}, {{1, 2, 50, 0.5}, {3, 2, 50, 0.25}});
  StepState<Sphere, double> state;
  const StepReport report = step(tight_steps(0.9), kernels(), bed, state);
  CHECK(report.kinetic_energy == Approx((1.0 + 0.125) / 2 * 0.5 * 0.04));  // v = g dt = .2
  CHECK(report.mean_motion == Approx(0.04));                               // of both
}

TEMPLATE_TEST_CASE("a sphere resting on the floor carries its weight", "", float, double) {
  // The force is the weight up to the solver's residual; f32 adds its rounding.
  const double margin = std::is_same_v<TestType, float> ? 1e-5 : 2e-9;
  for (const double radius : {0.5, 0.25, 0.6}) {
    INFO("radius " << radius);
    SphereBed bed = make_bed({4, 4, periodic, walls}, {{2, 2, radius + 0.3, radius}});
    StepState<Sphere, TestType> state;
    StepSettings settings = tight_steps(0.9);
    settings.limits.iterations = 1000;
    const StepReport report = take_steps(200, settings, bed, state);
    const auto impulses = testing::impulses_of(bed, state.contacts);
    const auto force = static_cast<double>(impulses.at({0, testing::wall_name(bed, 0)})) / 0.04;
    CHECK(force == about(sphere_mass(radius), margin));
    CHECK(bed.position[0].z == about(radius, margin));
    CHECK(report.kinetic_energy < 1e-9);
    CHECK(report.carried == about(1, 10 * margin));
  }
}

// Grains exactly above each other: no force is horizontal, so the column stands though it could not
// in nature. A residual of 1e-9 m g in each of 50 rows adds up to an error of a force of at most
// 50^2 / 2 times that.
TEST_CASE("in a column of 50 the contact under grain k from the top carries k weights") {
  const int grains = 50;
  SphereBed bed = testing::column_bed(grains, 1e-3);
  StepState<Sphere, double> state;
  const StepSettings settings = tight_steps(0.5);
  take_steps(150, settings, bed, state);
  const auto forces = forces_of(bed, state, settings.dt);
  CHECK(forces.at({0, testing::wall_name(bed, 0)}) == about(grains, 2e-6));
  for (std::int32_t k = 1; k < grains; ++k) {
    CHECK(forces.at({k - 1, k}) == about(grains - k, 2e-6));
    CHECK(bed.position[static_cast<std::size_t>(k)].z == about(k + 0.5, 1e-7));
    CHECK(bed.position[static_cast<std::size_t>(k)].x == 2);
    CHECK(bed.position[static_cast<std::size_t>(k)].y == 2);
  }
}

// The centres are (.8, .6) apart in (y, z): the upper weight 1 = .6 N, each wall carries .8 N.
TEST_CASE("two spheres wedged between walls push them as a wedge does") {
  SphereBed bed = make_bed({4, 1.8, periodic, walls}, {{2, 0.52, 0.51, 0.5}, {2, 1.28, 1.2, 0.5}});
  StepState<Sphere, double> state;
  const StepSettings settings = tight_steps(0.5);
  take_steps(300, settings, bed, state);
  CHECK(bed.position[0].y == about(0.5, 1e-6));
  CHECK(bed.position[1].y == about(1.3, 1e-6));
  CHECK(bed.position[1].z == about(1.1, 1e-6));
  const auto forces = forces_of(bed, state, settings.dt);
  CHECK(forces.at({0, 1}) == about(5.0 / 3, 1e-6));
  CHECK(forces.at({0, testing::wall_name(bed, 0)}) == about(2, 1e-6));
  CHECK(forces.at({0, testing::wall_name(bed, 1)}) == about(4.0 / 3, 1e-6));
  CHECK(forces.at({1, testing::wall_name(bed, 2)}) == about(4.0 / 3, 1e-6));
}

// Centres (.6, .6, h) apart with h^2 = 1 - .72: N = 1 / h, and .6 N on each of four walls.
TEST_CASE("a sphere in a corner holds another one in the opposite corner") {
  SphereBed bed = make_bed({1.6, 1.6, walls, walls}, {{0.5, 0.5, 0.5, 0.5}, {1.1, 1.1, 1.1, 0.5}});
  StepState<Sphere, double> state;
  const StepSettings settings = tight_steps(0.5);
  take_steps(300, settings, bed, state);
  const double rise = std::sqrt(1 - 0.72);
  CHECK(bed.position[1].z == about(0.5 + rise, 1e-6));
  const auto forces = forces_of(bed, state, settings.dt);
  CHECK(forces.at({0, 1}) == about(1 / rise, 1e-6));
  CHECK(forces.at({0, testing::wall_name(bed, 0)}) == about(2, 1e-6));
  for (const ContactName& wall : {ContactName{0, testing::wall_name(bed, 1)},
                                  {1, testing::wall_name(bed, 2)},
                                  {0, testing::wall_name(bed, 3)},
                                  {1, testing::wall_name(bed, 4)}}) {
    CHECK(forces.at(wall) == about(0.6 / rise, 1e-6));
  }
}

TEST_CASE("a sphere alone in a corner leans on no wall") {
  SphereBed bed = make_bed({4, 4, walls, walls}, {{0.5, 0.5, 0.5, 0.5}});
  StepState<Sphere, double> state;
  take_steps(20, tight_steps(0.5), bed, state);
  const auto forces = forces_of(bed, state, 0.2);
  REQUIRE(forces.size() == 3);
  CHECK(forces.at({0, testing::wall_name(bed, 0)}) == about(1, 1e-8));
  CHECK(forces.at({0, testing::wall_name(bed, 1)}) == 0);
  CHECK(forces.at({0, testing::wall_name(bed, 3)}) == 0);
}

// A sweep with momentum gives 0.9 of the impulse that a single contact needs.
TEST_CASE("the residual of a step is a force in weights, whatever the length of the step") {
  for (const double dt : {0.1, 0.2, 0.3}) {
    SphereBed bed = make_bed({4, 4, periodic, walls}, {{2, 2, 0.5, 0.5}});
    StepState<Sphere, double> state;
    StepSettings settings = tight_steps(0.5);
    settings.dt = dt;
    settings.limits.iterations = 1;
    CHECK(step(settings, kernels(), bed, state).solve.residual == Approx(0.1));
  }
}

TEST_CASE("the path that a solve leaves is told over the degrees of freedom") {
  SphereBed bed = testing::column_bed(5, 0.0);
  StepState<Sphere, double> state;
  StepSettings settings = tight_steps(0.0);
  settings.limits.iterations = 3;
  const StepReport report = step(settings, kernels(), bed, state);
  CHECK(report.solve.loaded == 5.0);
  CHECK((report.solve.rms > 0.0 && report.solve.rms <= report.solve.residual));
  const double path = report.solve.rms * settings.dt * settings.dt;
  CHECK(report.spurious_path == Approx(path * 5.0 / 15.0));
}

TEST_CASE("forces and velocities stay as they are when steps become shorter or longer") {
  for (const double ratio : {0.25, 2.0}) {
    SphereBed bed = testing::column_bed(5, 0.0);
    StepState<Sphere, double> state;
    StepSettings settings = tight_steps(0.9);
    take_steps(3, settings, bed, state);
    for (std::size_t i = 0; i < bed.grains(); ++i) bed.motion[i].x = 0.01 * double(i);
    const auto before = forces_of(bed, state, settings.dt);
    change_step(ratio, bed, state);
    const auto after = forces_of(bed, state, ratio * settings.dt);
    REQUIRE(after.size() == 5);
    for (const auto& [name, force] : before) CHECK(after.at(name) == Approx(force));
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      CHECK(bed.motion[i].x / (ratio * settings.dt) == Approx(0.01 * double(i) / settings.dt));
    }
  }
}

TEST_CASE("a grain that falls on another one does not pass through it") {
  SphereBed bed = make_bed({8, 5, periodic, walls}, {{2, 2, 0.5, 0.5}, {2, 2, 12, 0.5}});
  StepState<Sphere, double> state;
  for (int k = 0; k < 200; ++k) {
    step(tight_steps(0.9), kernels(), bed, state);
    REQUIRE(testing::gap_of(bed, 0, 1) > -0.15);  // one step's longest free motion
  }
  CHECK(bed.position[1].z == about(1.5, 1e-6));
}

// Forty grains on one spot are more than the solver's bound of eigenvalues allows for: its impulses
// grow.
TEST_CASE("no grain is thrown further in a step than the longest motion") {
  std::vector<PlacedSphere> spheres(40, {2, 2, 0.5, 0.5});
  for (std::size_t k = 0; k < 20; ++k) spheres[k].radius = 0.1;
  SphereBed bed = make_bed({4, 4, periodic, walls}, spheres);
  StepState<Sphere, double> state;
  StepSettings settings = tight_steps(0.9);
  settings.limits.iterations = 5;
  for (int k = 0; k < 10; ++k) {
    const SphereBed before = bed;
    const StepReport report = step(settings, kernels(), bed, state);
    REQUIRE(report.largest_motion <= longest_motion);
    for (std::size_t i = 0; i < bed.grains(); ++i) {
      const Record<double>& u = bed.motion[i];
      REQUIRE(std::hypot(u.x, u.y, u.z) <= longest_motion + 1e-12);
    }
  }
}

TEST_CASE("grains that touch across a periodic border push each other apart") {
  SphereBed bed = make_bed({4, 1, periodic, walls}, {{0.2, 0.5, 0.5, 0.5}, {3.4, 0.5, 0.5, 0.5}});
  StepState<Sphere, double> state;
  take_steps(3, tight_steps(0.0), bed, state);
  CHECK(testing::gap_of(bed, 0, 1) == Approx(0).margin(1e-8));
  CHECK(bed.position[0].x + bed.position[1].x == about(3.6, 1e-8));
}

TEST_CASE("an overlap is repaired by a step's share, without giving the grains speed to keep") {
  SphereBed bed = make_bed({8, 5, periodic, walls}, {{2, 2, 0.5, 0.5}, {2.8, 2, 0.5, 0.5}});
  StepState<Sphere, double> state;
  StepSettings settings = tight_steps(0.0);
  settings.correction = 0.1;
  step(settings, kernels(), bed, state);
  CHECK(testing::gap_of(bed, 0, 1) == about(-0.18, 1e-8));
  step(settings, kernels(), bed, state);
  CHECK(testing::gap_of(bed, 0, 1) == about(-0.162, 1e-8));
}

TEST_CASE("candidates are searched in the first step and kept while they hold") {
  SphereBed bed = make_bed({8, 5, periodic, walls}, {{2, 2, 0.5, 0.5}, {4, 2, 0.5, 0.5}});
  StepState<Sphere, double> state;
  step(tight_steps(0.5), kernels(), bed, state);
  CHECK(state.candidates.is_listed);
  const std::vector<Record<double>> looked_up_at = state.candidates.built_at;
  step(tight_steps(0.5), kernels(), bed, state);
  CHECK(testing::same_bits(state.candidates.built_at, looked_up_at));
}

// Each grain bears forces that balance its weight; all residuals together stay far below 1e-3.
TEST_CASE("the floor carries the weight of a small bed at rest") {
  SphereBed bed = testing::random_bed({{3, 3, periodic, walls}, 40, 0.3, 0.5, 12, 3});
  StepState<Sphere, double> state;
  const StepReport report = take_steps(400, tight_steps(0.8), bed, state);
  double weight = 0, floor = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    weight += sphere_mass(bed.position[i].w);
  }
  for (const auto& [name, force] : forces_of(bed, state, 0.2)) {
    floor += name.second == testing::wall_name(bed, 0) ? force : 0.0;
  }
  CHECK(floor == Approx(weight).epsilon(1e-3));
  CHECK(report.carried == Approx(floor / weight));
}

TEST_CASE("steps give the same bits for every instruction set") {
  for (const bool f32 : {true, false}) {
    std::uint64_t first_hash = 0;
    for (const Isa isa : testing::testable_isas()) {
      SphereBed bed = testing::random_bed({{4, 3, periodic, walls}, 80, 0.3, 0.5, 12, 5});
      StepState<Sphere, float> narrow;
      StepState<Sphere, double> wide;
      for (int k = 0; k < 60; ++k) {
        const StepSettings settings;
        f32 ? step(settings, kernels_for(isa), bed, narrow)
            : step(settings, kernels_for(isa), bed, wide);
      }
      INFO(name_of(isa) << (f32 ? ", f32" : ", f64"));
      first_hash = isa == Isa::sse2 ? state_hash(bed) : first_hash;
      CHECK(state_hash(bed) == first_hash);
    }
  }
}

}  // namespace
}  // namespace grainsweep
