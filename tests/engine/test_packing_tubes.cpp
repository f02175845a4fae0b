// Packings in tubes: what is known exactly of them, and what every packing promises.
#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/settle.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/packing.hpp"
#include "engine/scene/start.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/part_loops.hpp"
#include "tests/support/placed.hpp"

namespace grainsweep {
namespace {

using testing::always;

PackingSpec tube_spec(double diameter, std::int64_t grains, const char* accuracy) {
  PackingSpec spec;
  spec.box = tube_of(diameter);
  spec.fill = GrainCount{grains};
  spec.sizes.spread = 0.0;
  spec.accuracy = *preset(accuracy);
  spec.measure.exclude_floor = 2.0;
  spec.measure.exclude_surface = 2.0;
  spec.random_key = 7;
  return spec;
}

Packing packed(const PackingSpec& spec) {
  REQUIRE(check(spec).empty());
  return make_packing(spec, testing::kernels(), always);
}

/// Grains of a single file at rest: neighbours stand opposite each other at the wall.
struct Chain {
  double tube;
  std::int64_t grains;

  double apart() const { return tube - 1.0; }  ///< of neighbours, along the floor
  double rise() const { return std::sqrt(2.0 * tube - tube * tube); }
  double height(std::int64_t grain) const { return 0.5 + rise() * static_cast<double>(grain); }
  /// Between a grain and the one above it, which bears those above.
  double force_above(std::int64_t grain) const {
    return static_cast<double>(grains - 1 - grain) / rise();
  }
  /// What the wall pushes: the horizontal parts of both neighbours' forces.
  double wall_force(std::int64_t grain) const {
    const double below = grain > 0 ? force_above(grain - 1) : 0.0;
    return apart() * (below + force_above(grain));
  }
};

/// Solved far below every gap and force that is compared.
Accuracy near_rounding() {
  Accuracy accuracy = *preset("accurate");
  accuracy.precision = Precision::f64;
  accuracy.residual_tolerance = 1e-10;
  accuracy.overlap_tolerance = 1e-11;
  accuracy.kinetic_tolerance = 1e-20;
  accuracy.rest_iterations = 2000;
  return accuracy;
}

void check_places(const Chain& chain, const Packing& packing) {
  const double middle = chain.tube / 2.0;
  const SettledGrain& first = packing.grains[0];
  for (std::int64_t i = 0; i < chain.grains; ++i) {
    const SettledGrain& grain = packing.grains[static_cast<std::size_t>(i)];
    INFO("grain " << i);
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    CHECK(grain.z == about(chain.height(i), 1e-9));
    CHECK(std::hypot(grain.x - middle, grain.y - middle) == about(chain.apart() / 2.0, 1e-9));
    CHECK(grain.x - middle == about(side * (first.x - middle), 1e-8));
    CHECK(grain.y - middle == about(side * (first.y - middle), 1e-8));
  }
}

void check_forces(const Chain& chain, const Packing& packing) {
  // What each grain's forces lack of balance adds up along the chain. Rows miss it by 1e-10 m g, a
  // grain, whose rows lie at an angle, by some times that.
  const double margin = 2e-9 * static_cast<double>(chain.grains);
  std::vector<double> of_walls;
  for (const SettledGrain& grain : packing.grains) of_walls.push_back(grain.force);
  of_walls[0] -= static_cast<double>(chain.grains);  // the floor bears all
  for (const PairForce& pair : packing.forces) {
    CHECK(pair.b == pair.a + 1);
    CHECK(pair.magnitude == about(chain.force_above(pair.a), margin));
    for (const std::int32_t grain : {pair.a, pair.b}) {
      of_walls[static_cast<std::size_t>(grain)] -= pair.magnitude;
    }
  }
  for (std::int64_t i = 0; i < chain.grains; ++i) {
    CHECK(of_walls[static_cast<std::size_t>(i)] == about(chain.wall_force(i), margin));
  }
}

// Spheres of one size in a tube of D <= 1 + sqrt(3) / 2 touch their neighbours and the wall alone.
TEST_CASE("the chain in a narrow tube is the exact one, place by place and force by force") {
  for (const double diameter : {1.001, 1.05, 1.3, 1.5, 1.7, 1.86}) {
    INFO("D = " << diameter);
    const Chain chain{diameter, 30};
    PackingSpec spec = tube_spec(diameter, chain.grains, "accurate");
    spec.accuracy = near_rounding();
    const Packing packing = packed(spec);
    INFO(packing.result.reason);
    REQUIRE(packing.result.status == PackingStatus::settled);
    check_places(chain, packing);
    check_forces(chain, packing);
    const Slab slab{packing.result.slab_bottom, packing.result.slab_top};
    double solid = 0.0;
    for (std::int64_t i = 0; i < chain.grains; ++i) {
      const double z = chain.height(i);
      solid += sphere_slab_volume(0.5, slab.bottom - z, slab.top - z);
    }
    CHECK(packing.result.solid_fraction ==
          about(solid / (spec.box.floor_area() * slab.height()), 1e-9));
  }
}

TEST_CASE("spheres in tubes of any width come to rest inside them") {
  for (const char* accuracy : {"fast", "balanced"}) {
    for (const double diameter : {1.0, 1.3, 1.8, 2.3, 3.0, 4.5}) {
      INFO("D = " << diameter << ", " << accuracy);
      const PackingSpec spec = tube_spec(diameter, 120, accuracy);
      const Packing packing = packed(spec);
      INFO(packing.result.reason);
      CHECK(packing.result.status == PackingStatus::settled);
      for (const SettledGrain& grain : packing.grains) {
        const double from_axis = std::hypot(grain.x - diameter / 2, grain.y - diameter / 2);
        const double overlap = from_axis + 0.5 - diameter / 2;
        REQUIRE(overlap < 100 * spec.accuracy.overlap_tolerance);  // no pair may be deeper
      }
    }
  }
}

TEST_CASE("a packing in a tube has the same bits for every instruction set") {
  for (const double diameter : {1.4, 3.5}) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      PackingSpec spec = tube_spec(diameter, 150, "fast");
      spec.sizes = {0.03, 0.2, 0.5};
      spec.accuracy.precision = precision;
      const PackingResult expected = make_packing(spec, kernels_for(Isa::sse2), always).result;
      for (const Isa isa : testing::testable_isas()) {
        INFO("D = " << diameter << ", " << name_of(isa));
        const PackingResult result = make_packing(spec, kernels_for(isa), always).result;
        CHECK(result.state_hash == expected.state_hash);
        CHECK(result.solid_fraction == expected.solid_fraction);
        CHECK(result.rest.step_residual == expected.rest.step_residual);
      }
    }
  }
}

TEST_CASE("a bed in a tube goes on from saved bytes to the same bits") {
  const PackingSpec spec = tube_spec(2.2, 60, "fast");
  SphereBed whole = *start<Sphere>(spec);
  const SettleReport expected = settle(spec.accuracy, testing::kernels(), whole, always);
  for (std::int64_t last = 1; last < expected.steps; last += 41) {
    INFO("saved after step " << last << " of " << expected.steps);
    std::string saved;
    SphereBed first = *start<Sphere>(spec), bed = *start<Sphere>(spec);
    settle(spec.accuracy, testing::kernels(), first, [&](const Progress& progress) {
      saved = progress.step == last ? progress.save() : saved;
      return progress.step < last;
    });
    const auto report = settle(spec.accuracy, testing::kernels(), bed, always, saved);
    REQUIRE(state_hash(bed) == state_hash(whole));
    REQUIRE(report.steps == expected.steps);
  }
}

TEST_CASE("a settled bed of a tube placed again stays as it is") {
  PackingSpec spec = tube_spec(3.4, 120, "accurate");
  const Packing first = packed(spec);
  REQUIRE(first.result.status == PackingStatus::settled);
  PlacedGrains placed = testing::placed_as_in(first);
  spec.fill = placed;
  const Packing again = packed(spec);
  REQUIRE(again.result.status == PackingStatus::settled);
  for (std::size_t i = 0; i < first.grains.size(); ++i) {
    // What is left of its forces moves it no further than its gaps.
    CHECK(again.grains[i].z == about(first.grains[i].z, 1e-3));
  }
  placed.grains[7].x = 3.4;
  spec.fill = placed;
  REQUIRE(check(spec).size() == 1);
  CHECK(check(spec)[0].message.find("outside the tube") != std::string::npos);
}

// A plane that touches the wall where a grain was would throw it out or let it in: a grain without
// a way out would gain energy in every step.
TEST_CASE("a grain that slides along a round wall never gains energy") {
  testing::Draw draw(3);
  for (const double diameter : {1.02, 1.5, 3.0, 40.0}) {
    const double radius = diameter / 2.0, from_axis = radius - 0.5;
    SphereBed bed = make_bed(tube_of(diameter), {{radius + from_axis, radius, 0.5, 0.5}});
    bed.motion[0] = {draw.uniform(-0.1, 0.1), draw.uniform(0.05, 0.1), 0.0, 1.0};
    StepSettings settings;
    settings.dt = 0.05;
    settings.momentum = 1.0;
    settings.correction = 1.0;
    settings.limits.tolerance = 1e-9;
    StepState<Sphere, double> state;
    double speed = std::hypot(bed.motion[0].x, bed.motion[0].y);
    for (int k = 0; k < 200; ++k) {
      step(settings, testing::kernels(), bed, state);
      const double now = std::hypot(bed.motion[0].x, bed.motion[0].y);
      INFO("D = " << diameter << ", step " << k);
      REQUIRE(now <= speed * (1 + 1e-12));
      REQUIRE(bed.walls[1].gap(bed.position[0]) > -1e-9);
      speed = now;
    }
    // An implicit step turns by an angle and loses what leads outwards: narrow tubes halt it.
    if (diameter == 40.0) CHECK(speed > 0.05 * 0.9);
  }
}

PackingSpec pinacoids_in_tube(double diameter, std::int64_t grains) {
  PackingSpec spec = tube_spec(diameter, grains, "fast");
  spec.shape = PinacoidSize{};
  spec.measure.exclude_floor = spec.measure.exclude_surface = 1.0;
  return spec;
}

/// How far each grain's nearest vertex is from the wall, by nothing but its corners.
std::vector<double> wall_gaps(const Packing& packing, double diameter) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    const SettledGrain& grain = packing.grains[i];
    const auto& [x, y, z, w] = packing.turned->orientations[i];
    const Quaternion turn(w, x, y, z);
    double gap = diameter;
    for (const auto& vertex : packing.turned->meshes.front().vertices) {
      const Vector at = turn * (2.0 * grain.radius * Vector(vertex[0], vertex[1], vertex[2]));
      const double from_axis =
          std::hypot(grain.x + at.x() - diameter / 2, grain.y + at.y() - diameter / 2);
      gap = std::min(gap, diameter / 2 - from_axis);
    }
    gaps.push_back(gap);
  }
  return gaps;
}

TEST_CASE("pinacoids in a tube lie in it and touch its wall where their corners do") {
  constexpr double diameter = 6.0;
  PackingSpec spec = pinacoids_in_tube(diameter, 250);
  const Packing packing = packed(spec);
  INFO(packing.result.reason);
  REQUIRE(packing.result.status == PackingStatus::settled);
  const std::vector<double> gaps = wall_gaps(packing, diameter);
  const auto deepest = *std::min_element(gaps.begin(), gaps.end());
  CHECK(deepest > -100 * spec.accuracy.overlap_tolerance);  // no pair may be deeper
  const auto near = [&](double gap) { return gap < 1e-4; };
  CHECK(std::count_if(gaps.begin(), gaps.end(), near) > 20);
  std::int64_t touching = 0;
  for (const ProfileBin& bin : packing.result.profile_z.bins) touching += bin.walls;
  std::int64_t expected = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const SettledGrain& grain = packing.grains[i];
    const auto& [x, y, z, w] = packing.turned->orientations[i];
    double lowest = grain.z;
    for (const auto& vertex : packing.turned->meshes.front().vertices) {
      const Vector corner = Quaternion(w, x, y, z) * Vector(vertex[0], vertex[1], vertex[2]);
      lowest = std::min(lowest, grain.z + 2.0 * grain.radius * corner.z());
    }
    expected += (gaps[i] < 1e-4 ? 1 : 0) + (lowest < 1e-4 ? 1 : 0);
  }
  CHECK(touching == expected);
}

TEST_CASE("pinacoids in a tube have the same bits for every instruction set") {
  PackingSpec spec = pinacoids_in_tube(4.5, 60);
  spec.accuracy.max_steps = 60;
  const PackingResult expected = make_packing(spec, kernels_for(Isa::sse2), always).result;
  for (const Isa isa : testing::testable_isas()) {
    INFO(name_of(isa));
    CHECK(make_packing(spec, kernels_for(isa), always).result.state_hash == expected.state_hash);
  }
}

TEST_CASE("a tube too narrow for its polyhedra is refused with the least diameter") {
  PackingSpec spec = pinacoids_in_tube(3.0, 60);
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "tube.diameter");
}

TEST_CASE("the largest of a distribution of sizes is what a tube of polyhedra is wide for") {
  PackingSpec spec = pinacoids_in_tube(6.0, 60);
  CHECK(check(spec).empty());
  spec.sizes.distribution = {UniformSizes{1.0, 2.5}, SizeWeight::number};
  const auto errors = check(spec);
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].path == "tube.diameter");
}

TEST_CASE("a large bed in a tube has the same bits however its parts are shared out", "[slow]") {
  PackingSpec spec =
      tube_spec(22, static_cast<std::int64_t>(large_bed_grains<Sphere>) + 500, "fast");
  spec.accuracy.max_steps = 60;
  const PackingResult expected = make_packing(spec, testing::kernels(), always).result;
  for (const ParallelFor& loop :
       {ParallelFor(testing::last_part_first), ParallelFor(testing::two_threads)}) {
    const ExecutionContext context(testing::kernels(), loop);
    const PackingResult result = make_packing(spec, context, always).result;
    CHECK(result.state_hash == expected.state_hash);
    CHECK(result.rest.step_residual == expected.rest.step_residual);
  }
}

// Beside walls ever flatter spheres lie as beside a flat one: in a duct of the same width, but for
// its corners, and a tube has D / 2 times its wall for its floor as a square has.
TEST_CASE("a wide tube holds spheres as densely as a box between walls", "[slow]") {
  PackingSpec tube = tube_spec(16, 4500, "balanced"), box = tube;
  tube.measure.exclude_floor = box.measure.exclude_floor = 3.0;
  tube.measure.exclude_surface = box.measure.exclude_surface = 3.0;
  box.box = {16, 16, Boundary::walls, Boundary::walls};
  const PackingResult round = packed(tube).result, square = packed(box).result;
  REQUIRE(round.status == PackingStatus::settled);
  REQUIRE(square.status == PackingStatus::settled);
  // Beds of 4500 differ by 0.001; corners of the box and the curvature of the tube by about 0.002.
  CHECK(round.solid_fraction == about(square.solid_fraction, 0.008));
}

}  // namespace
}  // namespace grainsweep
