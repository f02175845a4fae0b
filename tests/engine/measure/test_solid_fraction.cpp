#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/solid_fraction.hpp"
#include "engine/shape/given_shape.hpp"
#include "engine/units.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/shape_beds.hpp"
#include "tests/support/shapes.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

TEST_CASE("a slab that holds a sphere holds its volume, one beside it nothing") {
  for (const double radius : {0.1, 0.5, 2.0}) {
    CHECK(sphere_slab_volume(radius, -9, 9) == Approx(sphere_volume(radius)).epsilon(1e-15));
    CHECK(sphere_slab_volume(radius, -radius, radius) ==
          Approx(sphere_volume(radius)).epsilon(1e-15));
    CHECK(sphere_slab_volume(radius, radius, 9) == 0);
    CHECK(sphere_slab_volume(radius, -9, -radius) == 0);
    CHECK(sphere_slab_volume(radius, radius + 1, radius + 2) == 0);
  }
}

TEST_CASE("half a sphere has half its volume, a cap pi h^2 (3 r - h) / 3") {
  for (const double radius : {0.1, 0.5, 2.0}) {
    CHECK(sphere_slab_volume(radius, 0, 9) == Approx(sphere_volume(radius) / 2).epsilon(1e-15));
    for (const double share : {0.01, 0.3, 1.0, 1.7}) {
      const double h = share * radius, cap = pi * h * h * (3 * radius - h) / 3;
      CHECK(sphere_slab_volume(radius, radius - h, 9) == Approx(cap).epsilon(1e-12));
      CHECK(sphere_slab_volume(radius, -9, h - radius) == Approx(cap).epsilon(1e-12));
    }
  }
}

TEST_CASE("a share of small grains is that of their volume in the slab, however far grains reach") {
  const auto upright = [](double x, double scale) {
    return testing::pose_at(x, 2, 3, Quaternion::Identity(), scale);
  };
  const ConvexShape pillar = *shape_of(CuboidSize{1, 1, 4}).shape;  // its longest edge lies along z
  const PolyhedronBed pillars =
      testing::shape_bed({8, 4, periodic, walls}, pillar, {upright(2, 1.0), upright(5, 0.5)});
  REQUIRE(pillars.shape(0).volume == Approx(4));
  CHECK(small_share(pillars, {-infinity, infinity}, 0.3) == Approx(0.5 / 4.5).epsilon(1e-14));
  const SphereBed spheres =
      make_bed({8, 4, periodic, walls}, {{2, 2, 2, 0.5}, {5, 2, 2, 0.25}, {6, 2, 3, 0.25}});
  CHECK(small_share(spheres, {-infinity, infinity}, 0.3) == Approx(0.2).epsilon(1e-14));
  CHECK(small_share(spheres, {0, 2}, 0.3) == Approx(1.0 / 9.0).epsilon(1e-14));  // half of two
  CHECK(small_share(spheres, {2.6, 4}, 0.3) == 1);
  CHECK(std::isnan(small_share(spheres, {5, 6}, 0.3)));
}

TEST_CASE("slabs that fill a sphere have its volume together") {
  const double radius = 0.7, volume = sphere_volume(radius);
  double sum = 0;
  for (int k = 0; k < 17; ++k) {
    sum += sphere_slab_volume(radius, -0.8 + 0.1 * k, -0.7 + 0.1 * k);
  }
  CHECK(sum == Approx(volume).epsilon(1e-14));
}

TEST_CASE("a thin slab has the volume of its disc") {
  const double z = 0.3, radius = 0.5, thickness = 1e-6;
  const double disc = pi * (radius * radius - z * z) * thickness;
  CHECK(sphere_slab_volume(radius, z - thickness / 2, z + thickness / 2) ==
        Approx(disc).epsilon(1e-9));
}

// A slab as high as whole cells holds the volume of whole cells, wherever it begins.
TEST_CASE("a simple cubic block fills pi / 6, a face-centred one pi / sqrt 18") {
  const SphereBed cubic = testing::simple_cubic_bed(3, 4, 8);
  const SphereBed fcc = testing::fcc_bed(2, 3, 6);
  const double edge = std::sqrt(2.0);
  for (const double bottom : {1.0, 1.3, 1.5, 1.87}) {
    CHECK(solid_fraction(cubic, {bottom, bottom + 4}) == Approx(pi / 6).epsilon(1e-12));
    CHECK(solid_fraction(fcc, {bottom, bottom + 4 * edge}) ==
          Approx(pi / std::sqrt(18.0)).epsilon(1e-12));
  }
}

TEST_CASE("the mean of slabs of equal height is the solid fraction of all of them") {
  const SphereBed bed = testing::random_bed({{6, 4, periodic, walls}, 300, 0.1, 0.5, 9, 3});
  const int slabs = 37;
  const double height = 8.0 / slabs;
  double sum = 0;
  for (int k = 0; k < slabs; ++k) {
    sum += solid_fraction(bed, {0.7 + k * height, 0.7 + (k + 1) * height});
  }
  CHECK(sum / slabs == Approx(solid_fraction(bed, {0.7, 8.7})).epsilon(1e-12));
}

TEST_CASE("a slab around everything holds the volume of all grains") {
  const SphereBed bed = testing::random_bed({{6, 4, periodic, walls}, 300, 0.1, 0.5, 9, 4});
  double volume = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    volume += sphere_volume(bed.position[i].w);
  }
  CHECK(solid_fraction(bed, {-1, 11}) == Approx(volume / (6 * 4 * 12)).epsilon(1e-13));
}

TEST_CASE("an empty bed has no solid fraction and no height") {
  const SphereBed bed = make_bed({6, 4, periodic, walls}, {});
  CHECK(solid_fraction(bed, {0, 1}) == 0);
  CHECK(surface_height(bed) == 0);
}

TEST_CASE("the surface of a block lies at the top of its highest layer") {
  CHECK(surface_height(testing::simple_cubic_bed(5, 5, 7)) == Approx(7));
}

TEST_CASE("the surface is the median of the columns: stray grains and holes do not count") {
  SphereBed bed = testing::simple_cubic_bed(5, 5, 7);
  for (std::size_t i = bed.grains() - 25; i < bed.grains() - 15; ++i) {
    bed.position[i].z += 20;  // ten grains of the top layer, far up
  }
  CHECK(surface_height(bed) == Approx(7));
  for (std::size_t i = bed.grains() - 15; i < bed.grains() - 5; ++i) {
    bed.position[i].z -= 5;  // ten grains gone from it
  }
  CHECK(surface_height(bed) == Approx(7));
  for (std::size_t i = bed.grains() - 25; i < bed.grains() - 5; ++i) {
    bed.position[i].z = 0.5;  // twenty gone: most columns end a layer lower
  }
  CHECK(surface_height(bed) == Approx(6));
}

TEST_CASE("large grains have wide columns, so that a block of them has its height") {
  const SphereBed spheres = testing::simple_cubic_bed(4, 5, 3);
  std::vector<PlacedSphere> centres;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < spheres.grains(); ++i) {
    const Record<double>& p = spheres.position[i];
    centres.push_back({3 * p.x, 3 * p.y, 3 * p.z, 3 * p.w});
    poses.push_back(testing::pose_at(3 * p.x, 3 * p.y, 3 * p.z, Quaternion::Identity(), 3));
  }
  const Box box{12, 15, periodic, periodic};
  CHECK(surface_height(make_bed(box, centres)) == Approx(9));
  CHECK(surface_height(testing::shape_bed(box, testing::cube(), poses)) == Approx(9));
}

TEST_CASE("a few grains on a wide floor have no surface, and take no memory for its columns") {
  CHECK(surface_height(make_bed({1e6, 1e6, periodic, walls}, {{1, 1, 0.5, 0.5}})) == 0);
}

TEST_CASE("of two columns the higher one is the surface") {
  const Box box{2, 1, periodic, periodic};
  CHECK(surface_height(make_bed(box, {{0.5, 0.5, 0.5, 0.5}, {1.5, 0.5, 2.5, 0.5}})) == 3);
}

TEST_CASE("small grains leave columns as wide as d") {
  const Box box{2, 1, periodic, periodic};
  CHECK(surface_height(make_bed(box, {{0.5, 0.5, 0.25, 0.25}, {1.5, 0.5, 2.25, 0.25}})) == 2.5);
}

// Of 5 x 5 columns the corners stand outside: 21 are left, most of which have a grain.
TEST_CASE("columns outside a tube do not count") {
  std::vector<PlacedSphere> spheres;
  for (int i = 0; i < 5 && spheres.size() < 11; ++i) {
    for (int j = 0; j < 5 && spheres.size() < 11; ++j) {
      const bool is_corner = (i == 0 || i == 4) && (j == 0 || j == 4);
      if (!is_corner) spheres.push_back({i + 0.5, j + 0.5, 3, 0.5});
    }
  }
  CHECK(surface_height(make_bed(tube_of(5), spheres)) == 3.5);
  spheres.pop_back();
  CHECK(surface_height(make_bed(tube_of(5), spheres)) == 0);
}

TEST_CASE("grains beyond a periodic border stand above the columns of their images") {
  SphereBed bed = testing::random_bed({{6, 4, periodic, periodic}, 120, 0.5, 0.5, 6, 5});
  const double height = surface_height(bed);
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    bed.position[i].x += i % 2 == 0 ? 6 : -12;
    bed.position[i].y += i % 3 == 0 ? -8 : 4;
  }
  CHECK(surface_height(bed) == height);
}

}  // namespace
}  // namespace grainsweep
