#include <catch2/catch.hpp>

#include "engine/dynamics/shape_settle.hpp"
#include "engine/scene/shape_start.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::pose_at;
using testing::walls;

const Kernels& kernels() { return kernels_for(best_isa()); }
bool always(const Progress&) { return true; }

PackingSpec small_spec(std::uint64_t key = 1) {
  PackingSpec spec;
  spec.box = {6, 5, periodic, walls};
  spec.fill = SolidHeight{5};
  spec.random_key = key;
  return spec;
}

TEST_CASE("a bed of pinacoids settles within every tolerance of its accuracy") {
  for (const std::uint64_t key : {1U, 2U, 3U}) {
    INFO("key " << key);
    const PackingSpec spec = small_spec(key);
    auto bed = start_shapes(spec, pinacoid({}));
    REQUIRE(bed);
    const SettleReport report = settle(spec.accuracy, kernels(), *bed, always);
    INFO(report.steps << " steps, " << report.rest.contacts << " constraints of "
                      << report.rest.isostatic_contacts << ", overlap " << report.rest.overlap_mean
                      << " mean, " << report.rest.overlap_max << " most");
    CHECK(report.why_not == "");
    CHECK(report.steps < 400);
    CHECK(report.rest.overlap_max < 1e-3);  // no pair is left deep in another
    for (const Record<double>& c : bed->centre) REQUIRE(c.z > bed->shape.inradius * 0.85);
  }
}

TEST_CASE("a bed of hulls, which have no closed form, settles too") {
  const PackingSpec spec = small_spec();
  auto bed = start_shapes(spec, testing::hull_of(pinacoid({1, 1, 0.7, 1.2}).vertices));
  REQUIRE(bed);
  const SettleReport report = settle(spec.accuracy, kernels(), *bed, always);
  CHECK(report.why_not == "");
}

TEST_CASE("a lone grain on the floor has three constraints and is isostatic") {
  ShapeBed bed = make_shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  ShapeStepState<double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_projected_gradient, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  const RestReport rest = certify(bed, kernels(), settings.dt, state);
  CHECK(rest.contacts == 3);
  CHECK(rest.isostatic_contacts == 3);
  CHECK(rest.overlap_max < 1e-6);
}

TEST_CASE("overlaps are measured where the grains are, at the deepest point") {
  ShapeBed bed = make_shape_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  ShapeStepState<double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_projected_gradient, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  bed.centre[0].z -= 0.01;
  const RestReport rest = certify(bed, kernels(), settings.dt, state);
  CHECK(rest.overlap_max == Approx(0.01).margin(1e-6));
  CHECK(rest.overlap_mean == Approx(0.01).margin(1e-6));
}

TEST_CASE("forces of a settled stack are those on its grains and between them") {
  ShapeBed bed = make_shape_bed({6, 6, periodic, walls}, testing::cube(),
                                {pose_at(3, 3, 0.5), pose_at(3, 3, 1.5)});
  Accuracy accuracy;
  accuracy.precision = Precision::f64;
  const SettleReport report = settle(accuracy, kernels(), bed, always);
  REQUIRE(report.pair_forces.size() == 1);
  // Forces are true to the residual asked for, for each of the four points of a face.
  const double margin = 4 * accuracy.residual_tolerance;
  CHECK(report.pair_forces[0].magnitude == Approx(1).margin(margin));
  CHECK(report.pair_forces[0].height == Approx(1).margin(1e-3));
  CHECK(report.force[0] == Approx(3).margin(2 * margin));
  CHECK(report.force[1] == Approx(1).margin(margin));
}

TEST_CASE(
    "settling of shapes stops when it is asked to, and says what is missing at the last step") {
  const PackingSpec spec = small_spec();
  auto bed = start_shapes(spec, pinacoid({}));
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
  CHECK_FALSE(report.why_not.empty());
}

TEST_CASE("the progress of settling shapes never falls") {
  const PackingSpec spec = small_spec();
  auto bed = start_shapes(spec, pinacoid({}));
  REQUIRE(bed);
  double share = 0;
  settle(spec.accuracy, kernels(), *bed, [&](const Progress& progress) {
    REQUIRE(progress.share_done >= share);
    REQUIRE(progress.share_done <= 1);
    share = progress.share_done;
    return true;
  });
  CHECK(share > 0.8);
}

}  // namespace
}  // namespace grainsweep
