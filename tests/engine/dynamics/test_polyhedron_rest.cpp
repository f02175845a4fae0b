#include <catch2/catch.hpp>

#include "engine/dynamics/rest.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::kernels;
using testing::periodic;
using testing::pose_at;
using testing::walls;

TEST_CASE("a lone grain on the floor has three constraints and is isostatic") {
  PolyhedronBed bed = make_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  StepState<Polyhedron, double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  const RestReport rest = measure_rest(bed, kernels(), settings.dt, state);
  CHECK(rest.contacts == 3);
  CHECK(rest.isostatic_contacts == 3);
  CHECK(rest.overlap_max < 1e-6);
}

TEST_CASE("overlaps are measured where the grains are, at the deepest point") {
  PolyhedronBed bed = make_bed({6, 6, periodic, walls}, testing::cube(), {pose_at(3, 3, 0.5)});
  StepState<Polyhedron, double> state;
  StepSettings settings;
  settings.momentum = 0;
  settings.limits = {Solver::accelerated_gauss_seidel, 10'000, 1e-9};
  step(settings, kernels(), bed, state);
  bed.position[0].z -= 0.01;
  const RestReport rest = measure_rest(bed, kernels(), settings.dt, state);
  CHECK(rest.overlap_max == Approx(0.01).margin(1e-6));
  CHECK(rest.overlap_mean == Approx(0.01).margin(1e-6));
}

}  // namespace
}  // namespace grainsweep
