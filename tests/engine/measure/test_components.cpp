#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/components.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::pose_at;

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
  const auto components = measure_components(bed, touching, slab, 0.01);
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
}

TEST_CASE("a component without grains in the slab has no means, a bed of one shape no components") {
  PolyhedronBed bed = stacks();
  const auto components = measure_components(bed, {}, {1.1, 1.4}, 0.01);
  CHECK(components[0].slab_grains == 0);
  CHECK(std::isnan(components[0].coordination));
  CHECK(std::isnan(components[0].nematic[0]));
  CHECK(components[0].solid_fraction == 0);
  CHECK(components[1].slab_share == 1);
  const PolyhedronBed alone =
      make_bed({4, 4, periodic, periodic}, testing::cube(), {pose_at(1, 1, 0.5)});
  CHECK(measure_components(alone, {}, {0, 2}, 0.01).empty());
}

}  // namespace
}  // namespace grainsweep
