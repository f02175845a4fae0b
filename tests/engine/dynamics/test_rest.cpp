#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/step.hpp"
#include "tests/support/about.hpp"
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

constexpr double bed_dt = 0.5;
constexpr double one_weight = bed_dt * bed_dt;  // impulse of a force of 1 m g

/// A bed and its contacts, which push as told.
struct Pushed {
  SphereBed bed;
  StepState<Sphere, double> state;

  Pushed(const Box& box, const std::vector<PlacedSphere>& spheres) : bed(make_bed(box, spheres)) {
    state.contacts = testing::contacts_of<double>(bed, 0.1, kernels());
  }
  /// Force of the contact of grain a and grain b, m g.
  Pushed& with_pair(std::int32_t a, std::int32_t b, double force) {
    testing::set_impulses(bed, {{ContactName{a, b}, force * one_weight}}, state.contacts);
    return *this;
  }
  /// Force of the contact of grain a and wall k, m g; 0 is the floor.
  Pushed& with_wall(std::int32_t a, std::size_t k, double force) {
    return with_pair(a, wall_name(bed, k), force);
  }
  std::vector<ForceContact> forces() const { return force_contacts(bed, bed_dt, state.contacts); }
  std::int64_t modes() const { return zero_modes(bed, forces()); }
  RestReport rest() { return measure_rest(bed, kernels(), bed_dt, state); }
};

constexpr Box x_periodic{6, 4, periodic, walls};
constexpr Box all_walled{6, 4, walls, walls};

TEST_CASE("a grain alone on the floor slides freely in two directions") {
  CHECK(Pushed(x_periodic, {{2, 2, 0.5, 0.5}}).with_wall(0, 0, 1).modes() == 2);
}

TEST_CASE("a wall that pushes takes a grain's freedom along its axis") {
  CHECK(Pushed(x_periodic, {{2, 0.5, 0.5, 0.5}}).with_wall(0, 0, 1).with_wall(0, 1, 1).modes() ==
        1);
  CHECK(Pushed(all_walled, {{5.5, 2, 0.5, 0.5}}).with_wall(0, 0, 1).with_wall(0, 2, 1).modes() ==
        1);
  CHECK(Pushed(all_walled, {{0.5, 0.5, 0.5, 0.5}})
            .with_wall(0, 0, 1)
            .with_wall(0, 1, 1)
            .with_wall(0, 3, 1)
            .modes() == 0);
}

TEST_CASE("a wall that a grain only touches takes no freedom") {
  CHECK(Pushed(x_periodic, {{2, 0.5, 0.5, 0.5}}).with_wall(0, 0, 1).with_wall(0, 1, 1e-7).modes() ==
        2);
}

TEST_CASE("every cluster that stands on the floor has its own free directions") {
  const std::vector<PlacedSphere> spheres = {{2, 2, 0.5, 0.5}, {3, 2, 0.5, 0.5}};
  CHECK(Pushed(x_periodic, spheres).with_wall(0, 0, 1).with_wall(1, 0, 1).modes() == 4);
  CHECK(Pushed(x_periodic, spheres)
            .with_wall(0, 0, 1)
            .with_wall(1, 0, 1)
            .with_pair(0, 1, 1)
            .modes() == 2);
}

TEST_CASE("a wall that pushes one grain of a cluster holds the whole cluster") {
  Pushed pushed(x_periodic, {{2, 0.5, 0.5, 0.5}, {2, 1.3, 1.1, 0.5}, {2, 3, 0.5, 0.5}});
  pushed.with_wall(0, 0, 2).with_wall(0, 1, 1).with_pair(0, 1, 1).with_wall(2, 0, 1);
  CHECK(pushed.modes() == 1 + 2);
}

TEST_CASE("zero modes are listed by the grains that go and the direction across their walls") {
  Pushed pushed(x_periodic, {{2, 0.5, 0.5, 0.5}, {2, 1.3, 1.1, 0.5}, {2, 3, 0.5, 0.5}});
  pushed.with_wall(0, 0, 2).with_wall(0, 1, 1).with_pair(0, 1, 1).with_wall(2, 0, 1);
  const auto motions = free_motions(pushed.bed, pushed.forces());
  REQUIRE(static_cast<std::int64_t>(motions.size()) == pushed.modes());
  for (const FreeMotion& motion : motions) {
    CHECK(motion.direction.z() == 0.0);
    CHECK(motion.direction.norm() == 1.0);
    if (motion.grains.size() == 2) CHECK(std::abs(motion.direction.x()) == 1.0);
  }
  CHECK(clusters_that_turn(pushed.bed, pushed.forces()).empty());
}

TEST_CASE("clusters in a tube turn about its axis, where that is another motion than to slide") {
  const Box tube = tube_of(4);
  Pushed lone(tube, {{1, 2, 0.5, 0.5}});
  lone.with_wall(0, 0, 1);
  CHECK(lone.modes() == 2);  // a turn moves it as a slide does
  Pushed column(tube, {{1, 2, 0.5, 0.5}, {1, 2, 1.5, 0.5}});
  column.with_wall(0, 0, 2).with_pair(0, 1, 1);
  CHECK(column.modes() == 2);
  Pushed pair(tube, {{1, 2, 0.5, 0.5}, {1.6, 2, 1.3, 0.5}});
  pair.with_wall(0, 0, 2).with_pair(0, 1, 1);
  CHECK(pair.modes() == 3);
  CHECK(clusters_that_turn(pair.bed, pair.forces()).size() == 1);
  CHECK(clusters_that_turn(lone.bed, lone.forces()).empty());
  Pushed along_y(tube, {{2, 1, 0.5, 0.5}, {2, 1.6, 1.3, 0.5}});
  along_y.with_wall(0, 0, 2).with_pair(0, 1, 1);
  CHECK(along_y.modes() == 3);
}

TEST_CASE("grains in mid-air have no free directions on the floor, nor has an empty bed") {
  CHECK(Pushed(x_periodic, {{2, 2, 3, 0.5}}).modes() == 0);
  CHECK(Pushed(x_periodic, {{2, 0.5, 3, 0.5}}).with_wall(0, 1, 1).modes() == 0);
  CHECK(Pushed(x_periodic, {}).modes() == 0);
}

TEST_CASE("contacts that bear force are counted against three per grain less the free modes") {
  Pushed pushed(x_periodic, {{2, 0.5, 0.5, 0.5}, {2, 1.3, 1.1, 0.5}, {2, 3, 0.5, 0.5}});
  pushed.with_wall(0, 0, 2).with_wall(0, 1, 1).with_pair(0, 1, 1).with_wall(2, 0, 1);
  pushed.with_pair(1, 2, 0.5 * least_force);
  const RestReport rest = pushed.rest();
  CHECK(rest.contacts == 4);
  CHECK(rest.isostatic_contacts == 9 - 3);
}

TEST_CASE("a contact that bears a force across an open gap is not counted") {
  for (const double gap : {0.9e-4, 1.1e-4}) {
    Pushed pushed(x_periodic, {{2, 2, 0.5, 0.5}, {2, 2, 1.5 + gap, 0.5}});
    pushed.with_wall(0, 0, 2).with_pair(0, 1, 1);
    CHECK(pushed.rest().contacts == (gap < 1e-4 ? 2 : 1));
  }
}

TEST_CASE("a round wall holds a grain along it, too, and on the axis if the grain fills the tube") {
  Pushed chain(tube_of(1.6), {{0.5, 0.8, 0.5, 0.5}, {1.1, 0.8, 1.3, 0.5}});
  chain.with_wall(0, 0, 2).with_pair(0, 1, 1.25).with_wall(0, 1, 0.75).with_wall(1, 1, 0.75);
  const RestReport held = chain.rest();
  CHECK(held.contacts == 4);
  CHECK(held.held_by_turning == 2);
  CHECK(held.isostatic_contacts == 6 - 2);  // together they move along the wall, or about the axis
  Pushed column(tube_of(1), {{0.5, 0.5, 0.5, 0.5}, {0.5, 0.5, 1.5, 0.5}});
  column.with_wall(0, 0, 2).with_pair(0, 1, 1);
  CHECK(column.rest().contacts == 2);
  CHECK(column.rest().held_by_turning == 4);
}

TEST_CASE("walls hold a grain that fills the space between them, whatever they push it with") {
  const Box slit{6, 1, periodic, walls};
  for (const double push : {0.0, 2.0}) {
    Pushed column(slit, {{2, 0.5, 0.5, 0.5}, {2, 0.5, 1.5, 0.5}});
    column.with_wall(0, 0, 2).with_pair(0, 1, 1);
    if (push > 0.0) column.with_wall(1, 1, push).with_wall(1, 2, push);
    CHECK(column.rest().contacts == 2);
    CHECK(column.rest().held_by_turning == 0);
    CHECK(column.rest().isostatic_contacts == 6 - 2 - 1);  // held across the slit, free along it
  }
}

TEST_CASE("overlaps are those of force-bearing contacts, measured anew") {
  Pushed pushed(x_periodic, {{2, 2, 0.49, 0.5}, {2, 2, 1.46, 0.5}, {2, 2, 2.41, 0.5}});
  pushed.with_wall(0, 0, 2).with_pair(0, 1, 1);  // the third pair, .05 deep, does not push
  update_gaps(pushed.bed, kernels(), 0.1, pushed.state.contacts);
  const RestReport rest = pushed.rest();
  CHECK(rest.overlap_max == Approx(0.03));
  CHECK(rest.overlap_mean == Approx(0.02));
}

TEST_CASE("open contacts count as no overlap in the mean") {
  Pushed pushed(x_periodic, {{2, 2, 0.49, 0.5}, {2, 2, 1.54, 0.5}});
  pushed.with_wall(0, 0, 2).with_pair(0, 1, 1);
  const RestReport rest = pushed.rest();
  CHECK(rest.overlap_mean == Approx(0.005));
  CHECK(rest.overlap_max == Approx(0.01));
}

TEST_CASE("a bed without contacts has no overlap") {
  Pushed pushed(x_periodic, {{2, 2, 3, 0.5}});
  const RestReport rest = pushed.rest();
  CHECK(rest.contacts == 0);
  CHECK(rest.overlap_mean == 0);
  CHECK(rest.isostatic_contacts == 3);
}

TEST_CASE("forces are summed over all contacts of a grain, walls included") {
  Pushed pushed(x_periodic, {{2, 0.5, 0.5, 0.5}, {2, 1.3, 1.1, 0.5}, {4, 2, 3, 0.5}});
  pushed.with_wall(0, 0, 2).with_wall(0, 1, 1.25).with_pair(0, 1, 1.5);
  const auto force = force_sums(pushed.bed, pushed.forces());
  REQUIRE(force.size() == 3);
  CHECK(force[0] == Approx(4.75));
  CHECK(force[1] == Approx(1.5));
  CHECK(force[2] == 0);
}

RestReport perfect_rest() {
  RestReport rest;
  rest.contacts = rest.isostatic_contacts = 1000;
  return rest;
}

/// Pair forces after one step from rest, solved to 1e-9 m g; a column of six adds up six such
/// errors.
std::vector<PairForce> forces_at_rest(SphereBed& bed) {
  StepSettings settings;
  settings.momentum = 0.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 100'000, 1e-9};
  StepState<Sphere, double> state;
  REQUIRE(step(settings, kernels(), bed, state).solve.residual <= 1e-9);
  return pair_forces(bed, force_contacts(bed, settings.dt, state.contacts), {}).first;
}

TEST_CASE("each contact of a column carries the weight of the grains above it") {
  SphereBed bed = testing::column_bed(6, 0.0);
  const auto forces = forces_at_rest(bed);
  REQUIRE(forces.size() == 5);
  for (const PairForce& force : forces) {
    CHECK(force.b == force.a + 1);
    CHECK(force.height == Approx(force.a + 1.0));
    CHECK(force.magnitude == about(5.0 - force.a, 1e-6));
  }
}

TEST_CASE("grains that lie side by side exert no force on each other") {
  SphereBed bed =
      make_bed({4, 4, Boundary::periodic, Boundary::walls}, {{1, 1, 0.5, 0.5}, {2, 1, 0.5, 0.5}});
  CHECK(forces_at_rest(bed).empty());
}

// Two grains between walls .9 apart beyond a diameter hold a third one up: f = 1/2 / sin(angle).
TEST_CASE("a grain on two others shares its weight between them") {
  const double rise = 0.6, half = 0.8;
  SphereBed bed = make_bed(
      {6, 1 + 2 * half, Boundary::periodic, Boundary::walls},
      {{3, 0.5, 0.5, 0.5}, {3, 0.5 + 2 * half, 0.5, 0.5}, {3, 0.5 + half, 0.5 + rise, 0.5}});
  const auto forces = forces_at_rest(bed);
  REQUIRE(forces.size() == 2);
  for (const PairForce& force : forces) CHECK(force.magnitude == about(0.5 / 0.6, 1e-6));
}

TEST_CASE("a bed within every tolerance is at rest") {
  const Accuracy accuracy;
  RestReport rest = perfect_rest();
  CHECK(rest_failure(rest, accuracy).empty());
  rest.step_residual = accuracy.residual_tolerance;
  rest.kinetic_energy = accuracy.kinetic_tolerance;
  rest.overlap_mean = accuracy.overlap_tolerance;
  rest.overlap_max = deepest_overlap * accuracy.overlap_tolerance;
  rest.contacts = 1000 - static_cast<std::int64_t>(1000 * accuracy.contact_tolerance);
  CHECK(rest_failure(rest, accuracy).empty());
}

TEST_CASE("the test of rest that failed is named with value and tolerance") {
  Accuracy accuracy;
  accuracy.residual_tolerance = 5e-3;
  accuracy.kinetic_tolerance = 2e-4;
  accuracy.overlap_tolerance = 1e-5;
  accuracy.contact_tolerance = 0.04;
  RestReport residual = perfect_rest(), kinetic = residual, overlap = residual, deep = residual,
             few = residual;
  residual.step_residual = 0.025;
  kinetic.kinetic_energy = 0.125;
  overlap.overlap_mean = 2e-3;
  deep.overlap_max = 0.06;
  few.contacts = 900;
  CHECK(rest_failure(residual, accuracy) ==
        "residual of the last step 0.025 m g exceeds 0.005: make accuracy.rest_iterations larger, "
        "which is 100, or accuracy.residual_tolerance");
  residual.step_residual = 0.25;
  CHECK(
      rest_failure(residual, accuracy) ==
      "residual of the last step 0.25 m g exceeds 0.005: give sizes a spread, as of 1e-2, if equal "
      "grains just fit between walls; else make accuracy.rest_iterations larger, which is 100");
  CHECK(rest_failure(kinetic, accuracy) ==
        "kinetic energy 0.125 m g d per grain exceeds 0.0002: make accuracy.kinetic_tolerance "
        "larger");
  CHECK(rest_failure(overlap, accuracy) ==
        "mean overlap 0.002 d exceeds 1e-05: make accuracy.rest_iterations larger, "
        "which is 100, or accuracy.overlap_tolerance");
  CHECK(rest_failure(deep, accuracy) ==
        "deepest overlap 0.06 d exceeds 0.001: make accuracy.rest_iterations larger, "
        "which is 100, or accuracy.overlap_tolerance");
  CHECK(rest_failure(few, accuracy) ==
        "contacts / isostatic count 0.9 is below 1 by more than 0.04: make "
        "accuracy.creep_steps larger, which is 480, or accuracy.contact_tolerance");
  RestReport column = few;
  column.contacts = few.isostatic_contacts / 2;
  CHECK(rest_failure(column, accuracy) ==
        "contacts / isostatic count 0.5 is below 1 by more than 0.04: its grains stand by "
        "symmetry, as columns do, or just fit: move the start a little or give sizes a spread");
  CHECK(rest_failure(few, accuracy, false) ==
        "contacts / isostatic count 0.9 is below 1 by more than 0.04: make accuracy.max_steps "
        "larger");
  Accuracy too_long = accuracy;
  too_long.step = 0.8;
  CHECK(rest_failure(overlap, too_long, false) ==
        "mean overlap 0.002 d exceeds 1e-05: make accuracy.step smaller, 0.4 sqrt(d/g) at most, "
        "for gravity outruns the motion of longer ones");
  CHECK(remedy_of_steps(accuracy) == "make accuracy.max_steps larger");
  CHECK(remedy_of_steps(too_long).starts_with("make accuracy.step smaller, 0.4 sqrt(d/g) at most"));
}

TEST_CASE("a bed out of balance is told what would call it balanced") {
  RestReport mean = perfect_rest(), largest = mean;
  mean.imbalance = {0.5, 0.5};
  largest.imbalance = {0.0, 7.5};
  Accuracy accuracy;
  accuracy.imbalance_tolerance = 0.125;
  const std::string remedy = ": make accuracy.imbalance_tolerance or accuracy.imbalance_gap larger";
  CHECK(rest_failure(mean, accuracy) ==
        "mean static imbalance 0.5 own weights exceeds 0.125" + remedy);
  CHECK(rest_failure(largest, accuracy) ==
        "largest static imbalance 7.5 own weights exceeds 1.88" + remedy);
}

TEST_CASE("polyhedra may rest on fewer contacts if they are balanced twice as well") {
  const Accuracy accuracy;
  RestReport rest = perfect_rest();
  rest.contacts = 950;
  CHECK_FALSE(rest_failure(rest, accuracy).empty());  // spheres may not
  rest.may_rest_on_fewer = true;
  const double half = accuracy.imbalance_tolerance / 2.0;
  rest.imbalance = {half, largest_imbalance * half};
  CHECK(rest_failure(rest, accuracy).empty());
  rest.imbalance.mean = 0.015;
  CHECK(
      rest_failure(rest, accuracy) ==
      "mean static imbalance 0.015 own weights exceeds 0.01, half of the tolerance since contacts "
      "/ isostatic count is 0.95: make accuracy.imbalance_tolerance or accuracy.imbalance_gap "
      "larger");
  rest.imbalance = {half, 1.01 * largest_imbalance * half};
  CHECK_FALSE(rest_failure(rest, accuracy).empty());
  rest.contacts = 1000;
  CHECK(rest_failure(rest, accuracy).empty());
  rest.imbalance = {};
  rest.contacts = 0;  // in the air
  CHECK_FALSE(rest_failure(rest, accuracy).empty());
}

TEST_CASE("more contacts than are needed are no fault, none at all is one") {
  RestReport rest = perfect_rest();
  rest.contacts = 2000;
  CHECK(rest_failure(rest, Accuracy{}).empty());
  rest.contacts = 0;
  CHECK_FALSE(rest_failure(rest, Accuracy{}).empty());
}

TEST_CASE("what a round wall holds by turning makes up for contacts that lack") {
  RestReport rest = perfect_rest();
  rest.contacts = 667;
  CHECK_FALSE(rest_failure(rest, Accuracy{}).empty());
  rest.held_by_turning = 333;
  CHECK(rest_failure(rest, Accuracy{}).empty());
}

TEST_CASE("a bed is hyperstatic if it has more contacts than the tolerance lets lack") {
  RestReport rest = perfect_rest();
  CHECK_FALSE(is_hyperstatic(rest, Accuracy{}));
  rest.contacts = 1019;
  CHECK_FALSE(is_hyperstatic(rest, Accuracy{}));
  rest.contacts = 1021;
  CHECK(is_hyperstatic(rest, Accuracy{}));
}

TEST_CASE("a number that is none never passes for rest") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (double RestReport::*value : {&RestReport::step_residual, &RestReport::kinetic_energy,
                                    &RestReport::overlap_mean, &RestReport::overlap_max}) {
    RestReport rest = perfect_rest();
    rest.*value = none;
    CHECK_FALSE(rest_failure(rest, Accuracy{}).empty());
  }
}

TEST_CASE("a high bed is advised to take f64 where f32 keeps its residual large") {
  RestReport rest = perfect_rest();
  Accuracy accuracy;
  rest.step_residual = 2.0 * accuracy.residual_tolerance;
  CHECK(remedy_of_rounding(rest, accuracy, 240.0) ==
        "; or rather take accuracy.precision f64: in f32 the forces of a bed 240 d high are not "
        "known "
        "better");
  CHECK(remedy_of_rounding(rest, accuracy, 20.0).empty());
  rest.kinetic_energy = 2.0 * accuracy.kinetic_tolerance;  // it has not come to rest yet
  CHECK(remedy_of_rounding(rest, accuracy, 240.0).empty());
  rest.kinetic_energy = 0.0;
  accuracy.precision = Precision::f64;
  CHECK(remedy_of_rounding(rest, accuracy, 240.0).empty());
  accuracy.precision = Precision::f32;
  rest.step_residual = accuracy.residual_tolerance;  // something else failed
  CHECK(remedy_of_rounding(rest, accuracy, 240.0).empty());
}

}  // namespace
}  // namespace grainsweep
