#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/components.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/shape/mixture.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::periodic;
using testing::pose_at;
using testing::shape_bed;

/// Two cubes on the floor, one on each of them a brick of half its height, the second of which
/// bears another cube.
PolyhedronBed stacks() {
  return make_bed({4, 4, periodic, periodic}, {testing::cube(), testing::box_shape(1, 1, 0.5)},
                  {0, 0, 1, 1, 0},
                  {pose_at(1, 1, 0.5), pose_at(3, 3, 0.5), pose_at(1, 1, 1.25), pose_at(3, 3, 1.25),
                   pose_at(3, 3, 2)});
}

TEST_CASE("grains, volumes and neighbours of components are what a small bed has") {
  PolyhedronBed bed = stacks();
  const Slab slab{0, 2};  // without the centre, and half of the volume, of the highest cube
  const Touching touching = find_touching(bed, 0.01, testing::kernels());
  const auto components = measure_components(bed, touching, {}, {}, slab, 0.01);
  REQUIRE(components.size() == 2);
  const auto &cubes = components[0], &bricks = components[1];
  CHECK((cubes.grains == 3 && cubes.slab_grains == 2));
  CHECK((bricks.grains == 2 && bricks.slab_grains == 2));
  CHECK(cubes.packed == Approx(0.75));
  CHECK(cubes.slab_share == Approx(2.5 / 3.5));
  CHECK(cubes.solid_fraction == Approx(2.5 / 32));
  CHECK(bricks.solid_fraction == Approx(1.0 / 32));
  CHECK(cubes.solid_fraction + bricks.solid_fraction == Approx(solid_fraction(bed, slab)));
  CHECK(cubes.neighbours == std::vector<double>{0, 1});
  CHECK(bricks.neighbours == std::vector<double>{1.5, 0});
  CHECK(cubes.coordination == 1);
  CHECK(cubes.coordination_with_walls == 2);  // and the floor
  CHECK(bricks.coordination_with_walls == 1.5);
  CHECK(cubes.nematic[2] == Approx(1));  // all upright
  // Of cubes on the floor that are not in the slab no wall counts.
  const auto above = measure_components(bed, touching, {}, {}, {1, 3}, 0.01);
  CHECK(above[0].slab_grains == 1);
  CHECK(above[0].coordination == 1);
  CHECK(above[0].coordination_with_walls == 1);
}

TEST_CASE("spheres of a mixture have no axes, and so no order") {
  const auto shapes = shapes_of(Mixture{{{0.5, CubeSize{}}, {0.5, SphereShape{}}}});
  const PolyhedronBed bed = make_bed({4, 4, periodic, periodic}, shapes, {0, 1},
                                     {pose_at(1, 1, 0.5), pose_at(3, 3, 0.5)});
  const auto components = measure_components(bed, {}, {}, {}, {0, 2}, 0.01);
  CHECK(components[0].nematic[2] == Approx(1));
  CHECK(std::isnan(components[1].nematic[2]));
}

std::vector<ForceLine> lines_over(const std::vector<int>& constraints) {
  std::vector<ForceLine> lines;
  for (const int kind : constraints) lines.push_back({{0, 0, 1}, {0, 0, 0}, kind});
  return lines;
}

TEST_CASE("contacts of two components stand with both, by their kind, if they are in the slab") {
  const PolyhedronBed bed = stacks();
  const std::vector<PairForce> forces = {
      {0, 2, 1, 1.0}, {3, 1, 1, 1.0}, {3, 1, 1, 1.2}, {0, 4, 1, 1.9}, {3, 4, 1, 2.1}};
  const auto lines = lines_over({3, 3, 1, 2, 3});
  const auto components = measure_components(bed, {}, forces, lines, {0, 2}, 0.01);
  using Kinds = std::vector<std::array<std::int64_t, 3>>;
  CHECK(components[0].contacts == Kinds{{0, 1, 0}, {1, 0, 2}});
  CHECK(components[1].contacts == Kinds{{1, 0, 2}, {0, 0, 0}});
}

TEST_CASE("the kinds of contact of each two components are those of a count over all pairs") {
  Draw draw(5);
  const std::size_t grains = 60;
  std::vector<std::uint8_t> components;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < grains; ++i) {
    components.push_back(static_cast<std::uint8_t>(draw.uniform(0, 3)));
    poses.push_back(pose_at(draw.uniform(0, 4), draw.uniform(0, 4), draw.uniform(1, 4)));
  }
  const PolyhedronBed bed = make_bed(
      {4, 4, periodic, periodic},
      {testing::cube(), testing::box_shape(1, 1, 0.5), testing::tetrahedron()}, components, poses);
  const Slab slab{1.5, 3};
  std::vector<PairForce> forces;
  std::vector<int> kinds;
  for (int k = 0; k < 500; ++k) {
    const auto any_grain = [&] { return static_cast<std::int32_t>(draw.uniform(0, grains)); };
    forces.push_back({any_grain(), any_grain(), draw.uniform(0, 9), draw.uniform(1, 4)});
    kinds.push_back(1 + static_cast<int>(draw.uniform(0, 3)));
  }
  const auto measured = measure_components(bed, {}, forces, lines_over(kinds), slab, 0.01);
  std::int64_t all = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t other = 0; other < 3; ++other) {
      for (int kind = 0; kind < 3; ++kind) {
        std::int64_t count = 0;
        for (std::size_t f = 0; f < forces.size(); ++f) {
          const PairForce& force = forces[f];
          const std::size_t a = components[static_cast<std::size_t>(force.a)];
          const std::size_t b = components[static_cast<std::size_t>(force.b)];
          const bool is_one = slab.contains(force.height) && kinds[f] == kind + 1 &&
                              ((a == k && b == other) || (a == other && b == k));
          count += is_one ? 1 : 0;
        }
        CHECK(measured[k].contacts[other][static_cast<std::size_t>(kind)] == count);
        all += k <= other ? count : 0;
      }
    }
  }
  CHECK(all == std::count_if(forces.begin(), forces.end(),
                             [&](const PairForce& force) { return slab.contains(force.height); }));
}

TEST_CASE("a component without grains in the slab has no means, a bed of one shape no components") {
  PolyhedronBed bed = stacks();
  const auto components = measure_components(bed, {}, {}, {}, {1.1, 1.4}, 0.01);
  CHECK(components[0].slab_grains == 0);
  CHECK(std::isnan(components[0].coordination));
  CHECK(std::isnan(components[0].nematic[0]));
  CHECK(components[0].solid_fraction == 0);
  CHECK(components[1].slab_share == 1);
  const PolyhedronBed alone =
      shape_bed({4, 4, periodic, periodic}, testing::cube(), {pose_at(1, 1, 0.5)});
  CHECK(measure_components(alone, {}, {}, {}, {0, 2}, 0.01).empty());
}

}  // namespace
}  // namespace grainsweep
