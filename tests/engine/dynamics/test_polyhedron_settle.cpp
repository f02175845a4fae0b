#include <catch2/catch.hpp>

#include "engine/dynamics/settle.hpp"
#include "engine/scene/start.hpp"
#include "engine/shape/pinacoid.hpp"
#include "tests/support/about.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::always;
using testing::kernels;
using testing::periodic;
using testing::pose_at;
using testing::shape_bed;
using testing::walls;

PackingSpec small_pinacoids(std::uint64_t key = 1) {
  PackingSpec spec;
  spec.box = {6, 5, periodic, walls};
  spec.fill = SolidHeight{5};
  spec.random_key = key;
  spec.shape = PinacoidSize{};
  return spec;
}

TEST_CASE("a bed of pinacoids settles within every tolerance of its accuracy", "[slow]") {
  for (const std::uint64_t key : {1U, 2U, 3U}) {
    INFO("key " << key);
    const PackingSpec spec = small_pinacoids(key);
    auto bed = start<Polyhedron>(spec);
    REQUIRE(bed);
    const SettleReport report = settle(spec.accuracy, kernels(), *bed, always);
    INFO(report.steps << " steps, " << report.rest.contacts << " constraints of "
                      << report.rest.isostatic_contacts << ", overlap " << report.rest.overlap_mean
                      << " mean, " << report.rest.overlap_max << " most");
    CHECK(report.failure == "");
    CHECK(report.rest.overlap_max < 1e-3);  // no pair is left deep in another
    for (const Record<double>& c : bed->centres()) REQUIRE(c.z > bed->shapes[0].inradius * 0.85);
  }
}

TEST_CASE("a bed of pinacoids whose forces balance less closely than is asked for does not rest") {
  PackingSpec spec = small_pinacoids();
  spec.box = {4, 4, periodic, walls};
  spec.fill = GrainCount{40};
  auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  const SettleReport settled = settle(spec.accuracy, kernels(), *bed, always);
  REQUIRE(settled.failure == "");
  const Imbalance left = settled.rest.imbalance;
  CHECK((left.mean > 0 && left.mean <= spec.accuracy.imbalance_tolerance));
  CHECK(left.max > left.mean);
  // Its steps end, some time or other, in a quench that all other tests of rest allow.
  spec.accuracy.imbalance_tolerance = 1e-7;
  constexpr int most_more = 400;
  bool is_refused = false;
  for (int more = 0; more < most_more && !is_refused; more += 5) {
    spec.accuracy.max_steps = static_cast<int>(settled.steps) + more;
    bed = start<Polyhedron>(spec);
    const SettleReport unsettled = settle(spec.accuracy, kernels(), *bed, always);
    is_refused = unsettled.failure.find("static imbalance") != std::string::npos;
    if (is_refused) CHECK(unsettled.rest.imbalance.mean > spec.accuracy.imbalance_tolerance);
  }
  CHECK(is_refused);
}

TEST_CASE("a bed of pinacoids that settles is the same whatever steps are left") {
  PackingSpec spec = small_pinacoids();
  spec.box = {4, 4, periodic, walls};
  spec.fill = GrainCount{40};
  auto whole = start<Polyhedron>(spec);
  REQUIRE(whole);
  const SettleReport expected = settle(spec.accuracy, kernels(), *whole, always);
  REQUIRE(expected.failure == "");
  for (const int more : {-1, 0, 1, 3}) {
    INFO("steps left: " << more);
    spec.accuracy.max_steps = static_cast<int>(expected.steps) + more;
    auto bed = start<Polyhedron>(spec);
    REQUIRE(bed);
    CHECK(settle(spec.accuracy, kernels(), *bed, always).failure.empty() == (more >= 0));
    if (more >= 0) CHECK(state_hash(*bed) == state_hash(*whole));
  }
}

TEST_CASE("a bed of hulls, which have no closed form, settles too", "[slow]") {
  PackingSpec spec = small_pinacoids();
  spec.shape = testing::asked_for(pinacoid({1, 1, 0.7, 1.2}).vertices);
  auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  const SettleReport report = settle(spec.accuracy, kernels(), *bed, always);
  CHECK(report.failure == "");
}

TEST_CASE("forces of a settled stack are those on its grains and between them") {
  PolyhedronBed bed =
      shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5), pose_at(3, 3, 1.5)});
  Accuracy accuracy;
  accuracy.precision = Precision::f64;
  accuracy.residual_tolerance = 5e-3;
  const SettleReport report = settle(accuracy, kernels(), bed, always);
  REQUIRE(report.forces.size() == 1);
  // Forces are true to the residual asked for, for each of the four points of a face.
  const double margin = 4 * accuracy.residual_tolerance;
  CHECK(report.forces[0].magnitude == about(1, margin));
  CHECK(report.forces[0].height == about(1, 1e-3));
  CHECK(report.force[0] == about(3, 2 * margin));
  CHECK(report.force[1] == about(1, margin));
}

TEST_CASE(
    "settling of shapes stops when it is asked to, and says what is missing at the last step") {
  const PackingSpec spec = small_pinacoids();
  auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  const SettleReport stopped = settle(spec.accuracy, kernels(), *bed,
                                      [](const Progress& progress) { return progress.step < 5; });
  CHECK(stopped.cancelled);
  CHECK(stopped.steps == 5);
  Accuracy hasty = spec.accuracy;
  hasty.max_steps = 20;
  const SettleReport report = settle(hasty, kernels(), *bed, always);
  CHECK_FALSE(report.cancelled);
  CHECK(report.steps == 20);
  CHECK_FALSE(report.failure.empty());
}

/// Three grains above each other and one beside them, in the air.
PolyhedronBed few_grains(const ConvexShape& shape) {
  return shape_bed({4, 4, periodic, walls}, shape,
                   {pose_at(2, 2, 0.8), pose_at(2.1, 2.2, 2),
                    pose_at(2, 2, 3.2, Quaternion(0.8, 0.6, 0, 0)), pose_at(3.3, 2, 1)});
}

// f32 knows forces to 6e-8 of a weight, and 1e-12 is asked for. Nine rounds of 80 to 120 steps
// follow the fall and the creep, which take less than as many again; all 128 would take 10,000.
TEST_CASE("a bed whose forces rounding keeps from being found is given up after nine rounds") {
  PolyhedronBed bed = few_grains(testing::cube());
  Accuracy accuracy;
  accuracy.residual_tolerance = 1e-12;
  const SettleReport report = settle(accuracy, kernels(), bed, always);
  CHECK(report.failure.find("residual of the last step") != std::string::npos);
  CHECK(report.steps > 9 * 80);
  CHECK(report.steps < 2 * 9 * 120);
}

SettleReport settle_start(const PackingSpec& spec) {
  auto bed = start<Polyhedron>(spec);
  REQUIRE(bed);
  return settle(spec.accuracy, kernels(), *bed, always);
}

// Some cubes of this bed rock for some twenty rounds, which leave 0.03 m g and more. A round takes
// at most 120 steps, what comes before them some 800.
TEST_CASE("a bed whose grains rock for more than nine rounds comes to rest", "[slow]") {
  PackingSpec spec;
  spec.box = {3, 3, walls, walls};
  spec.fill = GrainCount{60};
  spec.shape = CubeSize{};
  spec.random_key = 38;
  const SettleReport report = settle_start(spec);
  CHECK(report.failure == "");
  CHECK(report.steps > 9 * 120 + 900);
}

// The corners of plates hold them more often than they can move. Where momentum drove a few grains
// round in circles, these beds found no rest in 16,700 steps; others take 300 to 2000.
TEST_CASE("plates come to rest whose corners hold them more often than they can move", "[slow]") {
  for (const std::uint64_t key : {76, 98, 104, 130}) {
    INFO("random key " << key);
    PackingSpec spec;
    spec.box = {3.7, 3.7, periodic, periodic};
    spec.fill = GrainCount{150};
    spec.shape = CuboidSize{1, 1, 0.1};
    spec.random_key = key;
    const SettleReport report = settle_start(spec);
    CHECK(report.failure == "");
    CHECK(report.steps < 4000);
  }
}

// Pressed out of an overlap by a turn of 0.013 d, a grain of this bed turned back in the next step,
// and so on for 16,800 steps.
TEST_CASE("a bed comes to rest in which a grain is pressed to and fro between others", "[slow]") {
  PackingSpec spec;
  spec.box = {6, 6, walls, walls};
  spec.fill = GrainCount{140};
  spec.shape = CylinderSize{2};
  spec.sizes.spread = 0.2;
  spec.random_key = 3534355180068443278U;
  const SettleReport report = settle_start(spec);
  CHECK(report.failure == "");
  CHECK(report.steps < 4000);
}

// Whether forces were found, the last test of rest has told, up to 80 steps before.
TEST_CASE("rounds that leave forces unsolved are counted alike by a bed that is stopped between") {
  Accuracy accuracy;
  accuracy.residual_tolerance = 1e-12;
  PolyhedronBed whole = few_grains(testing::cube());
  const SettleReport expected = settle(accuracy, kernels(), whole, always);
  const std::int64_t half = expected.steps / 2;
  for (const std::int64_t last : {half, half + 40, half + 80}) {
    INFO("saved after step " << last << " of " << expected.steps);
    std::string saved;
    PolyhedronBed first = few_grains(testing::cube()), bed = few_grains(testing::cube());
    settle(accuracy, kernels(), first, [&](const Progress& progress) {
      saved = progress.step == last ? progress.save() : saved;
      return progress.step < last;
    });
    CHECK(settle(accuracy, kernels(), bed, always, saved).steps == expected.steps);
    CHECK(state_hash(bed) == state_hash(whole));
  }
}

/// Four grains may stand on fewer points than they could.
Accuracy few_on_few_points() {
  Accuracy accuracy;
  accuracy.contact_tolerance = 1.0;
  return accuracy;
}

TEST_CASE("the progress of settling shapes never falls") {
  PolyhedronBed bed = few_grains(pinacoid({}));
  double share = 0;
  settle(few_on_few_points(), kernels(), bed, [&](const Progress& progress) {
    REQUIRE(progress.share_done >= share);
    REQUIRE(progress.share_done <= 1);
    share = progress.share_done;
    return true;
  });
  CHECK(share > 0.8);
}

TEST_CASE("turning grains that go on from saved bytes end with the same bits, in any stage") {
  Accuracy accuracy = few_on_few_points();
  for (const ConvexShape& shape : {pinacoid({}), testing::tetrahedron()}) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      accuracy.precision = precision;
      PolyhedronBed whole = few_grains(shape);
      const SettleReport expected = settle(accuracy, kernels(), whole, always);
      std::vector<std::int64_t> stops{expected.steps};
      for (std::int64_t last = 1; last < expected.steps; last += 29) stops.push_back(last);
      for (const std::int64_t last : stops) {
        INFO("saved after step " << last << " of " << expected.steps);
        std::string saved;
        PolyhedronBed first = few_grains(shape), bed = few_grains(shape);
        settle(accuracy, kernels(), first, [&](const Progress& progress) {
          saved = progress.step == last ? progress.save() : saved;
          return progress.step < last;
        });
        const SettleReport report = settle(accuracy, kernels(), bed, always, saved);
        REQUIRE(state_hash(bed) == state_hash(whole));
        REQUIRE(report.steps == expected.steps);
        REQUIRE(report.iterations == expected.iterations);
        REQUIRE(report.rest.step_residual == expected.rest.step_residual);
        REQUIRE(report.rest.imbalance.mean == expected.rest.imbalance.mean);
        REQUIRE(report.rest.imbalance.max == expected.rest.imbalance.max);
      }
    }
  }
}

// Beyond 1e-7 of their size numbers of f32 do not go, and the forces here are some m g.
TEST_CASE("turning grains in f64 come to rest a hundred times closer than f32 can tell") {
  Accuracy accuracy = few_on_few_points();
  accuracy.residual_tolerance = 1e-9;
  accuracy.rest_iterations = 1000;
  accuracy.max_steps = 200;
  const auto settled_in = [&](Precision precision) {
    accuracy.precision = precision;
    PolyhedronBed stack = shape_bed({6, 6, periodic, walls}, testing::cube(),
                                    {pose_at(3, 3, 0.5), pose_at(3.1, 3.07, 1.5)});
    return settle(accuracy, kernels(), stack, always);
  };
  const SettleReport exact = settled_in(Precision::f64);
  CHECK(exact.failure == "");
  CHECK(exact.rest.step_residual < 1e-9);
  CHECK(settled_in(Precision::f32).rest.step_residual > 1e-9);
}

TEST_CASE("saved bytes of spheres are not taken for polyhedra") {
  std::string saved;
  SphereBed spheres = make_bed({4, 4, periodic, walls},
                               {{1, 1, 1, 0.5}, {3, 1, 1, 0.5}, {1, 3, 1, 0.5}, {3, 3, 1, 0.5}});
  settle({}, kernels(), spheres, [&](const Progress& progress) {
    saved = progress.save();
    return false;
  });
  PolyhedronBed whole = few_grains(testing::cube()), bed = few_grains(testing::cube());
  const SettleReport expected = settle({}, kernels(), whole, always);
  CHECK(settle({}, kernels(), bed, always, saved).steps == expected.steps);
  CHECK(state_hash(bed) == state_hash(whole));
}

TEST_CASE("a stack that rests as it is given stays as it is") {
  PolyhedronBed bed = shape_bed({6, 6, walls, walls}, testing::cube(),
                                {pose_at(0.5, 0.5, 0.5), pose_at(0.5, 0.5, 1.5)});
  Accuracy accuracy;
  accuracy.precision = Precision::f64;
  accuracy.contact_tolerance = 1.0;  // corners in corners: more constraints than a grain can use
  const SettleReport report = settle(accuracy, kernels(), bed, always);
  CHECK(report.failure == "");
  CHECK(report.steps == 8);
  CHECK(bed.position[1].z ==
        about(1.5, 2.0 * accuracy.overlap_tolerance));  // at each of two contacts
}

}  // namespace
}  // namespace grainsweep
