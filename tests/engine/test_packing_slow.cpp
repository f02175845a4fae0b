// Whole packings of about 2000 grains: what a user gets, against what mechanics and earlier
// measurements say.

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/packing.hpp"
#include "engine/rows/subdomains.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/part_loops.hpp"
#include "tests/support/placed.hpp"
#include "tests/support/solvers.hpp"

namespace grainsweep {
namespace {

using testing::always;

PackingSpec bed_spec(double length, double width, Boundary y, const char* accuracy) {
  PackingSpec spec;
  spec.box = {length, width, Boundary::periodic, y};
  spec.accuracy = *preset(accuracy);
  spec.random_key = 20130708;
  return spec;
}

PackingResult pack(const PackingSpec& spec) {
  REQUIRE(check(spec).empty());
  const PackingResult result = make_packing(spec, kernels_for(best_isa()), always).result;
  INFO(result.reason);
  CHECK(result.status == PackingStatus::settled);
  return result;
}

// Frictionless grains at rest bear exactly 3 N - zero modes forces. Beds of this width solved to
// rounding have solid fractions of .605 to .607 and 5.415 +- .01 neighbours a grain; a preset may
// miss these by its loose solves, one bed by its own scatter.
TEST_CASE("a bed five diameters wide has the known solid fraction and coordination", "[slow]") {
  const PackingResult result = pack(bed_spec(20, 5, Boundary::walls, "accurate"));
  CHECK(result.grains == 1894);
  CHECK(result.solid_fraction == about(0.606, 0.008));
  CHECK(result.coordination[0].between_grains == about(5.42, 0.1));
  CHECK(static_cast<double>(result.rest.contacts) ==
        Approx(result.rest.isostatic_contacts).epsilon(0.006));
  CHECK(result.rest.overlap_mean < 5e-6);
}

// From no forces it takes several steps until the floor carries a bed of this height.
// Of 24 such beds 19 to 21 are found at rest by a look. The others are at rest, too, but while
// their forces are found from none some contacts open, and they slide on.
TEST_CASE("high settled beds placed again stay as they are", "[slow]") {
  int stay = 0;
  for (std::uint64_t key = 1; key <= 8; ++key) {
    PackingSpec spec = bed_spec(3, 3, Boundary::walls, "balanced");
    spec.fill = SolidHeight{40};
    spec.random_key = key;
    const Packing first = make_packing(spec, kernels_for(best_isa()), always);
    REQUIRE(first.result.status == PackingStatus::settled);
    spec.fill = testing::placed_as_in(first);
    const Packing again = make_packing(spec, kernels_for(best_isa()), always);
    CHECK(again.result.status == PackingStatus::settled);
    if (again.result.steps > 40) continue;  // more than a look
    CHECK(again.result.solid_fraction == about(first.result.solid_fraction, 1e-4));
    ++stay;
  }
  CHECK(stay >= 5);
}

// In the bulk every force between grains belongs to two of them: Z = 6, and rattlers there are
// none.
TEST_CASE("a bi-periodic bed has six neighbours a grain", "[slow]") {
  const PackingResult result = pack(bed_spec(10, 10, Boundary::periodic, "accurate"));
  CHECK(result.solid_fraction == about(0.637, 0.008));
  CHECK(result.coordination[0].between_grains == about(6.0, 0.1));
  CHECK(result.coordination[0].with_walls == result.coordination[0].between_grains);
}

TEST_CASE("the narrower a bed the looser it is, and the fewer neighbours its grains have",
          "[slow]") {
  double last_fraction = 0, last_neighbours = 0;
  for (const double width : {3.0, 5.0, 9.0}) {
    const PackingResult result = pack(bed_spec(90 / width, width, Boundary::walls, "balanced"));
    CHECK(result.solid_fraction > last_fraction);
    CHECK(result.coordination[0].between_grains > last_neighbours);
    last_fraction = result.solid_fraction;
    last_neighbours = result.coordination[0].between_grains;
  }
}

TEST_CASE("small grains fill the gaps between large ones", "[slow]") {
  PackingSpec spec = bed_spec(6, 6, Boundary::periodic, "balanced");
  const double one_size = pack(spec).solid_fraction;
  spec.sizes.small_share = 0.25;
  spec.sizes.size_ratio = 0.4;
  CHECK(pack(spec).solid_fraction > one_size + 0.01);
}

// Forces pass from the surface to the floor through three times as many grains as in a bed of equal
// ones. With the 40 sweeps of `fast` these four beds took 1300 steps in the mean, up to 1974; with
// as many as there are layers they take 490.
TEST_CASE("small grains in the holes of large ones take no more rounds to rest", "[slow]") {
  PackingSpec spec = bed_spec(4, 4, Boundary::periodic, "fast");
  spec.sizes.small_share = 0.3;
  spec.sizes.size_ratio = 0.333;
  constexpr std::uint64_t beds = 4;
  std::int64_t steps = 0;
  for (spec.random_key = 1; spec.random_key <= beds; ++spec.random_key) steps += pack(spec).steps;
  CHECK(steps < 800 * static_cast<std::int64_t>(beds));
}

TEST_CASE("beds settle within every tolerance of their accuracy, whatever the box", "[slow]") {
  for (const Box& box : {Box{7, 7, Boundary::walls, Boundary::walls},
                         Box{20, 2.5, Boundary::periodic, Boundary::walls},
                         Box{3, 3, Boundary::periodic, Boundary::periodic}}) {
    for (const char* accuracy : {"fast", "balanced", "accurate"}) {
      INFO(box.length << " x " << box.width << ", " << accuracy);
      PackingSpec spec = bed_spec(8, 8, Boundary::walls, accuracy);
      spec.box = box;
      const PackingResult result = pack(spec);
      CHECK(result.rest.step_residual <= spec.accuracy.residual_tolerance);
      CHECK(result.rest.kinetic_energy <= spec.accuracy.kinetic_tolerance);
      CHECK(result.rest.overlap_mean <= spec.accuracy.overlap_tolerance);
    }
  }
}

TEST_CASE("a packing has the same bits for every instruction set", "[slow]") {
  for (const Precision precision : {Precision::f32, Precision::f64}) {
    PackingSpec spec = bed_spec(10, 5, Boundary::walls, "balanced");
    spec.accuracy.precision = precision;
    const PackingResult expected = make_packing(spec, kernels_for(Isa::sse2), always).result;
    for (const Isa isa : testing::testable_isas()) {
      INFO(name_of(isa));
      const PackingResult result = make_packing(spec, kernels_for(isa), always).result;
      CHECK(result.state_hash == expected.state_hash);
      CHECK(result.iterations == expected.iterations);
      CHECK(result.rest.step_residual == expected.rest.step_residual);
      CHECK(result.solid_fraction == expected.solid_fraction);
      CHECK(result.coordination[0].between_grains == expected.coordination[0].between_grains);
    }
  }
}

// The first steps of a bed of several subdomains: the fall and its impacts on the floor.
TEST_CASE("a large packing has the same bits however its parts are shared out", "[slow]") {
  PackingSpec spec = bed_spec(20, 20, Boundary::walls, "fast");
  spec.fill = GrainCount{static_cast<std::int64_t>(large_bed_grains<Sphere>) + 500};
  spec.accuracy.max_steps = 40;
  for (const Solver solver : testing::all_solvers) {
    spec.accuracy.solver = solver;
    const PackingResult expected = make_packing(spec, kernels_for(best_isa()), always).result;
    for (const ParallelFor& loop :
         {ParallelFor(testing::last_part_first), ParallelFor(testing::two_threads)}) {
      const ExecutionContext context(kernels_for(best_isa()), loop);
      const PackingResult result = make_packing(spec, context, always).result;
      CHECK(result.state_hash == expected.state_hash);
      CHECK(result.rest.step_residual == expected.rest.step_residual);
      CHECK(result.rest.kinetic_energy == expected.rest.kinetic_energy);
    }
  }
}

TEST_CASE("both number types settle beds of the same solid fraction", "[slow]") {
  PackingSpec spec = bed_spec(12, 6, Boundary::walls, "balanced");
  const PackingResult narrow = pack(spec);
  spec.accuracy.precision = Precision::f64;
  const PackingResult wide = pack(spec);
  CHECK(narrow.solid_fraction == about(wide.solid_fraction, 0.008));
  CHECK(narrow.coordination[0].between_grains == about(wide.coordination[0].between_grains, 0.15));
}

// Its bottom falls asleep when it has filled up to 40 d, after some 180 steps.
TEST_CASE("a bed of polyhedra that cores share fills up while its bottom sleeps", "[slow]") {
  PackingSpec spec = bed_spec(10, 5, Boundary::walls, "balanced");
  spec.shape = PinacoidSize{};
  spec.fill = SolidHeight{33.0};
  REQUIRE(check(spec).empty());
  REQUIRE(grain_count(spec) >= static_cast<std::int64_t>(large_bed_grains<Polyhedron>));
  const auto result = make_packing(spec, kernels_for(best_isa()), [](const Progress& progress) {
                        return progress.step < 220;
                      }).result;
  CHECK(result.reason == "stopped on request");
  CHECK(result.status == PackingStatus::cancelled);
}

// Low beds have solid fractions of .662 to .667; where full steps let grains swing at the foot of
// this bed of 90 d, it was .670 to .676.
TEST_CASE("polyhedra under 90 d of others do not swing themselves denser", "[slow]") {
  PackingSpec spec = bed_spec(4, 4, Boundary::periodic, "fast");
  spec.shape = PinacoidSize{};
  spec.fill = SolidHeight{60.0};
  CHECK(pack(spec).solid_fraction == about(0.6645, 0.004));
}

}  // namespace
}  // namespace grainsweep
