#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "engine/measure/coordination.hpp"
#include "engine/measure/touching.hpp"
#include "engine/packing.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/keep_going.hpp"
#include "tests/support/placed.hpp"

namespace grainsweep {
namespace {

using testing::always;

PackingSpec small_spec(std::uint64_t key = 1) {
  PackingSpec spec;
  spec.box = {4, 4, Boundary::periodic, Boundary::walls};
  spec.fill = GrainCount{160};
  spec.accuracy = *preset("fast");
  spec.measure.exclude_floor = 2.0;
  spec.measure.exclude_surface = 1.5;
  spec.random_key = key;
  return spec;
}

Packing pack(const PackingSpec& spec) {
  REQUIRE(check(spec).empty());
  return make_packing(spec, kernels_for(best_isa()), always);
}

TEST_CASE("a small packing settles and is measured") {
  const Packing packing = pack(small_spec());
  const PackingResult& result = packing.result;
  CHECK(result.status == PackingStatus::settled);
  CHECK(result.reason == "");
  CHECK(result.grains == 160);
  CHECK(result.slab_bottom == 2.0);
  CHECK(result.slab_top == result.surface_height - 1.5);
  CHECK((result.solid_fraction > 0.5 && result.solid_fraction < 0.66));
  CHECK(result.steps > 50);
  CHECK(result.iterations > result.steps);
}

TEST_CASE("coordination is reported for every gap tolerance in the order asked for") {
  PackingSpec spec = small_spec();
  spec.measure.gap_tolerances = {1e-3, 1e-5, 6e-3};
  const auto coordination = pack(spec).result.coordination;
  REQUIRE(coordination.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(coordination[k].gap_tolerance == spec.measure.gap_tolerances[k]);
    CHECK(coordination[k].with_walls > coordination[k].between_grains);
  }
  CHECK(coordination[1].between_grains < coordination[0].between_grains);
  CHECK(coordination[0].between_grains < coordination[2].between_grains);
}

TEST_CASE("profiles and order of a packing belong to its solid fraction and coordination") {
  PackingSpec spec = small_spec();
  spec.fill = GrainCount{400};
  spec.sizes = {1.0 / 30.0, 0.25, 0.5};
  spec.measure.bin_width = 0.25;
  const Packing packing = pack(spec);
  const PackingResult& result = packing.result;
  REQUIRE(result.profile_y.bins.size() == 16);
  double solid = 0, small_solid = 0;
  std::int64_t grains = 0, small = 0, neighbours = 0;
  for (const ProfileBin& bin : result.profile_y.bins) {
    solid += (bin.large + bin.small) / 16;
    small_solid += bin.small / 16;
    grains += bin.large_grains + bin.small_grains;
    small += bin.small_grains;
    neighbours += bin.neighbours;
  }
  CHECK(solid == Approx(result.solid_fraction).epsilon(1e-12));
  CHECK(small_solid / solid == about(0.25, 0.08));  // a slab of a bed of 400 grains
  CHECK((small > grains / 2 && small < grains));
  CHECK(static_cast<double>(neighbours) / static_cast<double>(grains) ==
        Approx(result.coordination[0].between_grains).epsilon(1e-12));
  CHECK(static_cast<double>(result.profile_z.bins.size()) * 0.25 > result.surface_height);
  CHECK((result.order.q6_global > 0 && result.order.q6_global < result.order.q6_local));
  CHECK(std::isfinite(result.order.segregation));
  CHECK(result.order.force_mean > 1);
  CHECK((result.mean_diameter > 0.5 && result.mean_diameter < result.mean_diameter_by_volume));
  double cubes = 0.0, squares = 0.0;
  for (const SettledGrain& grain : packing.grains) {
    squares += grain.radius * grain.radius;
    cubes += grain.radius * grain.radius * grain.radius;
  }
  CHECK(result.sauter_diameter.value() == Approx(2.0 * cubes / squares).epsilon(1e-12));
}

TEST_CASE("the grains of a packing lie in the box with their forces and neighbours") {
  PackingSpec spec = small_spec();
  spec.accuracy = *preset("accurate");  // at coarser presets a grain that slides is not yet carried
  const Packing packing = pack(spec);
  REQUIRE(packing.grains.size() == 160);
  double neighbours = 0;
  for (const SettledGrain& grain : packing.grains) {
    CHECK((grain.x >= 0 && grain.x < 4));
    CHECK((grain.y > grain.radius - 1e-3 && grain.y < 4 - grain.radius + 1e-3));
    CHECK(grain.z > grain.radius - 1e-3);
    CHECK(grain.force > 0.9 * sphere_mass(grain.radius));
    neighbours += grain.touching;
  }
  CHECK(neighbours / 160 == about(4.5, 1));
}

TEST_CASE("the forces between grains and of walls are all that bears on each grain") {
  const Packing packing = pack(small_spec());
  std::vector<double> left;
  for (const SettledGrain& grain : packing.grains) left.push_back(grain.force);
  REQUIRE_FALSE(packing.forces.empty());
  for (const PairForce& force : packing.forces) {
    left.at(static_cast<std::size_t>(force.a)) -= force.magnitude;
    left.at(static_cast<std::size_t>(force.b)) -= force.magnitude;
  }
  double of_floor = 0.0, weight = 0.0;
  for (const WallForce& force : packing.wall_forces) {
    left.at(static_cast<std::size_t>(force.grain)) -= force.magnitude;
    if (force.wall == 0) of_floor += force.magnitude;
  }
  for (const SettledGrain& grain : packing.grains) weight += sphere_mass(grain.radius);
  const double rounding = 1e-9;
  CHECK(*std::min_element(left.begin(), left.end()) > -rounding);
  CHECK(*std::max_element(left.begin(), left.end()) < rounding);
  CHECK(of_floor == Approx(weight).epsilon(0.01));  // what balanced beds leave unbalanced
}

TEST_CASE("a grain's neighbours are counted at the first gap tolerance") {
  std::vector<std::int32_t> neighbours;
  for (const auto& tolerances : {std::vector{1e-5, 0.05}, std::vector{0.05, 1e-5}}) {
    PackingSpec spec = small_spec();
    spec.measure.gap_tolerances = tolerances;
    neighbours.push_back(0);
    for (const SettledGrain& grain : pack(spec).grains) {
      neighbours.back() += grain.touching;
    }
  }
  CHECK(neighbours[0] < neighbours[1]);
}

TEST_CASE("equal specifications give equal bits, another key gives another bed") {
  const Packing a = pack(small_spec(7)), b = pack(small_spec(7)), c = pack(small_spec(8));
  CHECK(a.result.state_hash == b.result.state_hash);
  CHECK(a.result.solid_fraction == b.result.solid_fraction);
  CHECK(a.result.iterations == b.result.iterations);
  CHECK(a.result.state_hash != c.result.state_hash);
}

/// A bed that settles, and what becomes of it from where its grains ended.
struct PlacedAgain {
  Packing first, again;
};
PlacedAgain pack_again(PackingSpec spec) {
  PlacedAgain both;
  both.first = pack(spec);
  REQUIRE(both.first.result.status == PackingStatus::settled);
  spec.fill = testing::placed_as_in(both.first);
  both.again = pack(spec);
  REQUIRE(both.again.result.status == PackingStatus::settled);
  return both;
}

TEST_CASE("a settled bed placed again stays as it is") {
  PackingSpec spec = small_spec();
  spec.accuracy = *preset("accurate");  // what coarser presets call rest still yields to a shake
  const auto [first, again] = pack_again(spec);
  CHECK(again.result.solid_fraction == about(first.result.solid_fraction, 1e-3));
  double moved = 0;
  for (std::size_t i = 0; i < first.grains.size(); ++i) {
    moved += std::abs(again.grains[i].z - first.grains[i].z) / 160;
  }
  CHECK(moved < 0.01);
}

// The static imbalance of this one is just above what is let pass after the first steps of a look.
TEST_CASE("a settled bed placed again is looked at for some steps more before it falls") {
  PackingSpec spec = small_spec(252);
  spec.box = tube_of(4);
  spec.fill = GrainCount{240};
  spec.accuracy = *preset("balanced");
  spec.accuracy.creep_steps = 160;  // few beds that have crept for longer look like this
  const auto [first, again] = pack_again(spec);
  CHECK(again.result.steps > 40);
  CHECK(again.result.steps <= 160);
  CHECK(again.result.solid_fraction == about(first.result.solid_fraction, 1e-4));
}

// Of these the forces are not found in eight steps that are solved as those at rest are.
TEST_CASE("a bed of cubes that rests is read again as it is, its forces looked for closer") {
  for (const std::uint64_t key : {3, 14}) {
    PackingSpec spec = small_spec(key);
    spec.box = tube_of(3.5);
    spec.shape = CubeSize{0.8};
    spec.fill = GrainCount{160};
    spec.accuracy = *preset("fast");
    const auto [first, again] = pack_again(spec);
    CHECK(again.result.steps <= 32);
    CHECK(again.result.solid_fraction == about(first.result.solid_fraction, 2e-4));
  }
}

TEST_CASE("spheres between walls one diameter apart settle, each held by both") {
  PackingSpec spec;
  spec.box = {10, 1, Boundary::periodic, Boundary::walls};
  spec.sizes.spread = 0.0;
  spec.fill = GrainCount{60};
  spec.measure.exclude_floor = spec.measure.exclude_surface = 0.5;
  const PackingResult result = pack(spec).result;
  CHECK(result.reason == "");
  CHECK(result.status == PackingStatus::settled);
}

// Eight beds each have phi = 0.4514 +- 0.0007 and 0.4530 +- 0.0009: single ones scatter by 0.0025.
TEST_CASE("beds in a narrow gap along x pack like those along y") {
  PackingSpec spec;
  spec.box = {1.2, 5, Boundary::walls, Boundary::walls};
  spec.fill = GrainCount{300};
  const PackingResult along_x = pack(spec).result;
  std::swap(spec.box.length, spec.box.width);
  const PackingResult along_y = pack(spec).result;
  REQUIRE(along_x.status == PackingStatus::settled);
  REQUIRE(along_y.status == PackingStatus::settled);
  CHECK(along_x.solid_fraction == about(along_y.solid_fraction, 0.0125));  // five of that scatter
  CHECK(along_x.profile_x.bins.size() == along_y.profile_y.bins.size());
}

// Each stands on one other and touches two walls.
TEST_CASE("spheres in a shaft narrower than two of them stand on each other") {
  PackingSpec spec;
  spec.box = {1.2, 1.2, Boundary::walls, Boundary::walls};
  spec.sizes.spread = 0.0;
  spec.fill = GrainCount{40};
  const Packing packing = pack(spec);
  REQUIRE(packing.result.status == PackingStatus::settled);
  CHECK(packing.result.rest.contacts == packing.result.rest.isostatic_contacts);
  CHECK(packing.result.coordination.front().between_grains == 2.0);
}

// Grains sleep under 40 d of others while a bed fills up.
TEST_CASE("a bed whose steps end in its fall is measured with what slept awake") {
  PackingSpec spec;
  spec.box = {3, 3, Boundary::periodic, Boundary::walls};
  spec.fill = SolidHeight{70};
  spec.accuracy.max_steps = 440;
  const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
  REQUIRE(packing.result.status == PackingStatus::not_settled);
  std::vector<PlacedSphere> spheres;
  for (const SettledGrain& grain : packing.grains) {
    spheres.push_back({grain.x, grain.y, grain.z, grain.radius});
  }
  SphereBed bed = make_bed(spec.box, spheres);
  const Coordination& measured = packing.result.coordination.front();
  const Coordination anew =
      coordination(bed, find_touching(bed, 2.0 * measured.gap_tolerance, kernels_for(best_isa())),
                   {packing.result.slab_bottom, packing.result.slab_top}, measured.gap_tolerance);
  CHECK(measured.between_grains == anew.between_grains);
  CHECK(measured.with_walls == anew.with_walls);
}

// Who stops it does not want to wait for a static balance of grains in the air.
TEST_CASE("a packing that the observer stops is cancelled, neither tested nor measured") {
  const Packing packing = make_packing(small_spec(), kernels_for(best_isa()),
                                       [](const Progress& progress) { return progress.step < 9; });
  CHECK(packing.result.status == PackingStatus::cancelled);
  CHECK(packing.result.steps == 9);
  CHECK(packing.result.rest.imbalance.max == 0.0);
  CHECK(packing.result.coordination.empty());
  CHECK(packing.grains.empty());
  CHECK_FALSE(packing.result.reason.empty());
}

TEST_CASE("a bed too low for its slab fails and says what to change") {
  PackingSpec spec = small_spec();
  spec.measure.exclude_floor = 30;
  const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
  CHECK(packing.result.status == PackingStatus::failed);
  CHECK(packing.result.reason.find("too low") != std::string::npos);
  CHECK(packing.result.reason.find("measure.exclude_floor") != std::string::npos);
  CHECK(packing.result.coordination.empty());
  CHECK(packing.grains.size() == 160);  // the bed itself can still be looked at
}

TEST_CASE("a bed whose grains are larger than the gap between walls fails and says why") {
  PackingSpec spec = small_spec();
  spec.box.width = 0.9;
  const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
  CHECK(packing.result.status == PackingStatus::failed);
  CHECK(packing.result.reason.find("larger than the gap") != std::string::npos);
  CHECK(packing.grains.empty());
}

TEST_CASE("a bed whose numbers are not finite fails by name instead of being packed") {
  for (const double x : {std::nan(""), 1.0}) {
    PackingSpec spec = small_spec();
    // Without a check the first reaches the engine as it is; the second has no finite inverse mass.
    spec.fill = PlacedGrains{{{x, 2, 2, x == 1.0 ? 1e-110 : 0.5}, {3, 2, 2, 0.5}}};
    const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
    CHECK(packing.result.status == PackingStatus::failed);
    CHECK(packing.result.reason.find("not a finite number at the start") != std::string::npos);
    CHECK(packing.grains.empty());
  }
}

TEST_CASE("a bed that blows up fails by name, with the step") {
  PackingSpec spec = small_spec();
  spec.accuracy.precision = Precision::f32;
  spec.fill = PlacedGrains{{{2, 2, 2, 1e-15}}};  // its inverse mass is beyond f32
  const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
  CHECK(packing.result.status == PackingStatus::failed);
  CHECK(packing.result.reason.find("the bed blew up in step 1:") != std::string::npos);
}

TEST_CASE("masses too far apart for f32 fail by name, and settle in f64") {
  PackingSpec spec = small_spec();
  spec.measure.exclude_floor = spec.measure.exclude_surface = 0;
  spec.fill = PlacedGrains{{{1, 1, 0.5, 0.5}, {3, 3, 0.01, 0.01}}};  // masses 1.25e5 to 1
  spec.accuracy.precision = Precision::f32;
  const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
  CHECK(packing.result.status == PackingStatus::failed);
  CHECK(packing.result.reason.find("take f64") != std::string::npos);
  spec.accuracy.precision = Precision::f64;
  CHECK(make_packing(spec, kernels_for(best_isa()), always).result.rest.contacts == 2);
}

TEST_CASE("a given bed whose grains sink into each other on the way is not called settled") {
  PackingSpec spec = small_spec();
  PlacedGrains lattice;  // all neighbours overlap by half
  for (int k = 0; k < 125; ++k) {
    lattice.grains.push_back({0.5 + 0.5 * (k % 5), 0.5 + 0.5 * (k / 5 % 5), 0.5 + 0.5 * (k / 25)});
  }
  spec.fill = lattice;
  spec.measure.exclude_floor = spec.measure.exclude_surface = 0.5;
  const PackingResult result = make_packing(spec, kernels_for(best_isa()), always).result;
  CHECK(result.status == PackingStatus::not_settled);
  CHECK(result.reason.find("may have passed through") != std::string::npos);
  CHECK(result.solid_fraction > 0);
}

TEST_CASE("a bed that runs out of steps is not settled, says why, and is still measured") {
  PackingSpec spec = small_spec();
  spec.measure.exclude_floor = spec.measure.exclude_surface = 1;
  spec.accuracy.max_steps = 30;
  const Packing packing = pack(spec);
  CHECK(packing.result.status == PackingStatus::not_settled);
  CHECK_FALSE(packing.result.reason.empty());
  CHECK(packing.result.steps == 30);
  CHECK(packing.result.solid_fraction > 0);
}

TEST_CASE("packings of one and of two grains end without a slab to measure") {
  for (const std::int64_t grains : {1, 2}) {
    PackingSpec spec = small_spec();
    spec.fill = GrainCount{grains};
    const Packing packing = make_packing(spec, kernels_for(best_isa()), always);
    CHECK(packing.result.status == PackingStatus::failed);
    CHECK(packing.result.reason.find("too low") != std::string::npos);
    CHECK(packing.result.rest.contacts == grains);
    CHECK(packing.grains.size() == static_cast<std::size_t>(grains));
  }
}

TEST_CASE("every status has a name") {
  CHECK(std::string(name_of(PackingStatus::settled)) == "settled");
  CHECK(std::string(name_of(PackingStatus::not_settled)) == "not_settled");
  CHECK(std::string(name_of(PackingStatus::cancelled)) == "cancelled");
  CHECK(std::string(name_of(PackingStatus::failed)) == "failed");
}

/// A packing of another spec in `measure` alone.
PackingSpec measured_otherwise(PackingSpec spec) {
  spec.measure.exclude_floor = 1.25;
  spec.measure.exclude_surface = 1.0;
  spec.measure.gap_tolerances = {1e-3, 1e-5};
  spec.measure.bin_width = 0.25;
  return spec;
}

// The stories of the program compare every table: tests/runner/program/measured_again.sh.
TEST_CASE("a bed is measured again as if it had been packed so") {
  PackingSpec turned = small_spec();
  turned.fill = GrainCount{160};
  turned.box.length = 4.5;  // of an image beside a grain
  turned.shape = PinacoidSize{};
  for (const PackingSpec& spec : {small_spec(), turned}) {
    const Packing made = pack(spec);
    const PackingSpec other = measured_otherwise(spec);
    const auto again = measure_again(other, kernels_for(best_isa()), made);
    REQUIRE(again);
    const Packing expected = pack(other);
    const PackingResult &result = again->result, &wanted = expected.result;
    CHECK(result.solid_fraction == wanted.solid_fraction);
    CHECK(result.solid_fraction != made.result.solid_fraction);
    CHECK(result.coordination.back().with_walls == wanted.coordination.back().with_walls);
    CHECK(result.force_density.values == wanted.force_density.values);
    CHECK(result.profile_y.bins.size() == 16);
    CHECK(result.rest.contacts == wanted.rest.contacts);
    CHECK(result.steps == wanted.steps);
    CHECK(result.iterations == wanted.iterations);
    CHECK(result.spurious_path == wanted.spurious_path);
    CHECK(result.state_hash == wanted.state_hash);
    REQUIRE(again->grains.size() == expected.grains.size());
    CHECK(again->grains.front().force == expected.grains.front().force);
    CHECK(again->wall_forces.size() == expected.wall_forces.size());
    CHECK(again->axes == expected.axes);
  }
}

TEST_CASE("only a bed at its end with the grains of the spec is measured again") {
  const PackingSpec spec = small_spec();
  const Kernels& kernels = kernels_for(best_isa());
  const Packing made = pack(spec);
  CHECK(measure_again(spec, kernels, made));
  Packing failed = made;
  failed.result.status = PackingStatus::failed;
  CHECK_FALSE(measure_again(spec, kernels, failed));
  Packing fewer = made;
  fewer.grains.pop_back();
  CHECK_FALSE(measure_again(spec, kernels, fewer));
  CHECK_FALSE(measure_again(small_spec(2), kernels, made));
  PackingSpec turned = spec;
  turned.shape = PinacoidSize{};
  CHECK_FALSE(measure_again(turned, kernels, made));
}

// Their path is (2 / 7)^2 of that of wide beds: engine/dynamics/stages.cpp.
TEST_CASE("grains of a narrow duct stray less than those of a wide box") {
  PackingSpec wide = small_spec(), duct = small_spec();
  wide.box = {6, 6, Boundary::periodic, Boundary::walls};
  wide.fill = SolidHeight{6};
  duct.box = {2, 2, Boundary::walls, Boundary::walls};
  duct.fill = SolidHeight{6};
  const double share = pack(duct).result.spurious_path / pack(wide).result.spurious_path;
  CAPTURE(share);
  CHECK(share < 0.4);
}

}  // namespace
}  // namespace grainsweep
