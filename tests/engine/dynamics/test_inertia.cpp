#include <cmath>
#include <type_traits>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/dynamics/inertia.hpp"
#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/settle.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::walls;

StepSettings steps_of_length(double dt) {
  StepSettings settings;
  settings.dt = dt;
  settings.limits = {Solver::accelerated_gauss_seidel, 100'000, 1e-9};
  return settings;
}

/// Grains in the air, of which the lowest are soon on the floor.
template <class Kind>
PackingSpec falling() {
  PackingSpec spec;
  spec.box = {4, 4, periodic, walls};
  spec.fill = GrainCount{120};
  if (std::is_same_v<Kind, Polyhedron>) spec.shape = PinacoidSize();
  return spec;
}

/// Ratio of the moments of inertia of a polyhedron to those of its mass.
double turning_inertia(const PolyhedronBed& bed, std::size_t grain) {
  PolyhedronBed usual = bed;
  usual.lightness.clear();
  return bed.root_inertia[grain].cwiseAbs2().x() / principal_moments(usual, grain).x();
}

TEST_CASE("inertia grows with depth from an even depth on, up to the mass at the foot") {
  SphereBed bed = testing::column_bed(40, 0.0);  // centres 0.5 to 39.5 d above the floor
  set_inertia_by_depth(40.0, bed);
  for (std::int32_t grain = 0; grain < 40; ++grain) {
    const double depth = 39.5 - grain;
    CHECK(1.0 / bed.inverse_inertia(grain) == Approx(std::max(depth, even_depth) / 40.0));
    CHECK(bed.inverse_mass(grain) == 1.0);
  }
  CHECK(bed.inverse_inertia(bed.wall()) == 0.0);
  CHECK(std::pow(shortened_step(40.0), 2) == Approx(even_depth / 40.0));
}

TEST_CASE("in a low bed inertia is mass, and steps are as long as ever") {
  SphereBed bed = testing::column_bed(9, 0.0);
  set_inertia_by_depth(9.5, bed);
  CHECK(bed.inverse_inertia(0) == 1.0);
  CHECK(shortened_step(9.5) == 1.0);
}

TEST_CASE("grains asleep stay fixed, however light they are") {
  SphereBed bed = testing::column_bed(40, 0.0);
  bed.asleep.assign(bed.grains(), 1);
  set_inertia_by_depth(40.0, bed);
  CHECK(bed.inverse_inertia(39) == 0.0);
}

TEST_CASE("moments of inertia change like the inertia, and back") {
  PackingSpec spec = falling<Polyhedron>();
  PolyhedronBed bed = start<Polyhedron>(spec).value();
  const std::vector<Vector> of_mass = bed.root_inertia;
  const double height = 50.0;
  set_inertia_by_depth(height, bed);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const double depth = height - bed.position[i].z;
    CHECK(turning_inertia(bed, i) == Approx(std::max(depth, even_depth) / height));
  }
  set_inertia_by_depth(0.0, bed);
  CHECK(bed.root_inertia == of_mass);
}

// u = u_free + dt^2 f / inertia: with a quarter of the inertia and half the step all motions are
// the same, and so are the forces. In twelve steps a heap begins; its faces that come to lie on
// each other later need a hundred thousand iterations to be as exact.
TEMPLATE_TEST_CASE(
    "grains that are four times lighter move in half a step as others in a whole one", "", Sphere,
    Polyhedron) {
  for (const bool is_light : {true, false}) {
    INFO((is_light ? "light" : "heavy"));
    Bed<TestType> usual = start<TestType>(falling<TestType>()).value();
    Bed<TestType> other = usual;
    const double lightness = is_light ? 4.0 : 0.25;
    other.lightness.assign(other.grains(), lightness);
    StepState<TestType, double> as_usual, as_other;
    for (int k = 0; k < 12; ++k) {
      const StepReport one = step(steps_of_length(0.1), kernels(), usual, as_usual);
      const StepReport two =
          step(steps_of_length(0.1 / std::sqrt(lightness)), kernels(), other, as_other);
      REQUIRE(two.carried == about(one.carried, 1e-6));
    }
    for (std::size_t i = 0; i < usual.grains(); ++i) {
      REQUIRE(other.position[i].x == about(usual.position[i].x, 1e-6));
      REQUIRE(other.position[i].y == about(usual.position[i].y, 1e-6));
      REQUIRE(other.position[i].z == about(usual.position[i].z, 1e-6));
    }
  }
}

TEST_CASE("at rest a column carries its weight, whatever its inertia") {
  SphereBed bed = testing::column_bed(20, 0.0);
  set_inertia_by_depth(20.0, bed);
  StepState<Sphere, double> state;
  StepSettings settings = steps_of_length(0.1 * shortened_step(20.0));
  settings.momentum = 0.0;
  const StepReport report = step(settings, kernels(), bed, state);
  CHECK(report.carried == about(1.0, 1e-6));
  for (const ForceContact& c : force_contacts(bed, settings.dt, state.contacts)) {
    const double above = bed.is_grain(c.b)
                             ? 19.5 - std::min(bed.position[static_cast<std::size_t>(c.a)].z,
                                               bed.position[static_cast<std::size_t>(c.b)].z)
                             : 20.0;
    CHECK(c.force == about(above, 1e-5));
  }
}

TEST_CASE(
    "a bed whose steps end in its creep is given back, and judged, with the inertia of mass") {
  PackingSpec spec;
  spec.box = {3, 3, periodic, walls};
  spec.fill = GrainCount{200};
  Accuracy accuracy;
  SphereBed bed = start<Sphere>(spec).value();
  bool was_light = false;
  const auto stops_in_creep = [&](const Progress& progress) {
    was_light = !bed.lightness.empty();
    return progress.step < 300;
  };
  settle(accuracy, kernels_for(best_isa()), bed, stops_in_creep);
  CHECK(was_light);
  accuracy.max_steps = 300;
  bed = start<Sphere>(spec).value();
  const SettleReport report = settle(accuracy, kernels_for(best_isa()), bed, testing::always);
  CHECK(bed.lightness.empty());
  // With the weights of light grains this would be a multiple of it.
  CHECK(report.rest.imbalance.mean < 0.5);
}

}  // namespace
}  // namespace grainsweep
