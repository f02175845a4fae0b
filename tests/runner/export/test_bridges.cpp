#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/export/bridges.hpp"
#include "runner/export/caps.hpp"
#include "runner/export/open_surfaces.hpp"
#include "tests/runner/export/closed_surfaces.hpp"
#include "tests/runner/export/packed_bed.hpp"
#include "tests/runner/export/touching_beds.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

ExportedBed bridged(ExportedBed exported, const char* treatment = "bridge:0.2") {
  exported.settings.treatment = *contact_treatment(treatment);
  return exported;
}

/// Two spheres of radii 0.5 and `other` above the floor, with a gap between them.
ExportedBed pair_of(double other, double gap) {
  ExportedBed exported = empty_box(6, 6, 0);
  exported.bed.grains = {{3, 3, 2, 0.5, 0, 0}, {3, 3, 2.5 + gap + other, other, 0, 0}};
  return bridged(exported);
}

/// Volume of a sphere without the cap beyond a circle of radius rim on it.
double without_cap(double radius, double rim) {
  const double depth = radius - std::sqrt(radius * radius - rim * rim);
  return 4.0 / 3.0 * pi * std::pow(radius, 3) - pi * depth * depth * (radius - depth / 3.0);
}

double height_within(double radius, double rim) { return std::sqrt(radius * radius - rim * rim); }

TEST_CASE("two spheres and their neck are one closed body of their volume") {
  for (const double other : {0.5, 0.2}) {
    for (const double gap : {-1e-6, 0.0, 1e-6, 0.01}) {
      const auto surfaces = bridged_surfaces(pair_of(other, gap));
      REQUIRE(surfaces.size() == 1);
      CHECK(surfaces[0].grains == 2);
      CHECK(is_closed(surfaces[0].surface));
      CHECK(euler_characteristic(surfaces[0].surface) == 2);
      CHECK(crossings(surfaces) == 0);
      const double rim = 0.2 * other;
      const double length = 0.5 + gap + other - height_within(0.5, rim) - height_within(other, rim);
      const double exact =
          without_cap(0.5, rim) + without_cap(other, rim) + pi * rim * rim * length;
      // A ball of 1280 triangles within its sphere lacks 0.85 %, a prism of 12 sides 4.5 % of 0.1
      // %.
      const double volume = volume_of(surfaces[0].surface);
      CHECK((volume < exact && volume > 0.99 * exact));
    }
  }
}

TEST_CASE("spheres further apart than a cap is deep stay alone") {
  const auto surfaces = bridged_surfaces(pair_of(0.5, 0.03));
  REQUIRE(surfaces.size() == 2);
  CHECK(surfaces[0].grains == 1);
}

/// Corners less edges plus faces of all bodies.
int euler_characteristic(const std::vector<GrainSurface>& surfaces) {
  return std::accumulate(surfaces.begin(), surfaces.end(), 0, [](int sum, const auto& body) {
    return sum + euler_characteristic(body.surface);
  });
}

/// Contacts between grains, and necks that are made of them.
struct Necks {
  int made = 0, asked = 0;
};

Necks necks_of(const ExportedBed& exported, const OpenSurfaces& open) {
  Necks necks;
  for (const Neck& neck : open.necks) necks.made += !neck.is_wall;
  for (const Contact& contact : treated_contacts(exported)) necks.asked += !contact.is_wall;
  return necks;
}

void check_bodies(const ExportedBed& exported, const OpenSurfaces& open) {
  const auto surfaces = bridged_surfaces(exported);
  for (const GrainSurface& body : surfaces) CHECK(is_closed(body.surface));
  int grains = 0;
  for (const GrainSurface& body : surfaces) grains += static_cast<int>(body.grains);
  CHECK(grains == static_cast<int>(exported.bed.grains.size()));
  CHECK(euler_characteristic(surfaces) == 2 * (grains - necks_of(exported, open).made));
  CHECK(crossings(surfaces) == 0);
}

TEST_CASE("a bed of spheres is joined by all its necks without a face through another") {
  const Box walls{3, 3, Boundary::walls, Boundary::walls};
  const ExportedBed bed =
      bridged(packed_bed(SphereShape{}, walls, testing::is_sanitized ? 13 : 25));
  const ExportedBed wide = bridged(bed, "bridge:0.6");  // necks that would meet on a grain
  for (const ExportedBed& one : {bed, wide}) {
    check_bodies(one, open_spheres(one));
    const Necks necks = necks_of(one, open_spheres(one));
    CHECK(necks.made == necks.asked);
  }
}

TEST_CASE("beds of polyhedra are joined at points, along lines and over areas") {
  const Box walls{4, 3, Boundary::walls, Boundary::walls};
  for (const ShapeSpec& shape : {ShapeSpec(CubeSize{}), ShapeSpec(PinacoidSize{})}) {
    const ExportedBed bed = bridged(packed_bed(shape, walls, testing::is_sanitized ? 16 : 40));
    check_bodies(bed, open_polyhedra(bed));
    const ExportedBed wide = bridged(bed, "bridge:0.6");
    check_bodies(wide, open_polyhedra(wide));
  }
}

// Single beds of cubes have necks at 0.90 to 0.99 of their contacts, sets of twelve at 0.947 +-
// 0.008. Of contacts with gaps up to 0.2 d many leave less than a tenth of a neck of 0.3 d: where
// such are asked for it is 0.641 +- 0.019. Of pinacoids it is 0.992 +- 0.002 and 0.833 +- 0.004
// (means and standard deviations of four sets). The bounds lie three of these below, or more.
TEST_CASE("nearly all contacts of polyhedra have a neck, and most of those that ask for a wide one",
          "[slow]") {
  const Box walls{4, 3, Boundary::walls, Boundary::walls};
  struct Least {
    ShapeSpec shape;
    double usual, wide;
  };
  for (const Least& least : {Least{CubeSize{}, 0.92, 0.58}, Least{PinacoidSize{}, 0.98, 0.81}}) {
    Necks usual, wide;
    const auto add = [](const ExportedBed& bed, Necks& sum) {
      const Necks own = necks_of(bed, open_polyhedra(bed));
      sum = {sum.made + own.made, sum.asked + own.asked};
    };
    for (std::int64_t grains = 36; grains < 60; grains += 2) {
      const ExportedBed bed = bridged(packed_bed(least.shape, walls, grains));
      add(bed, usual);
      add(bridged(bed, "bridge:0.6"), wide);
    }
    CHECK(usual.made >= least.usual * usual.asked);
    CHECK(wide.made >= least.wide * wide.asked);
  }
}

// On a triangular face holes hide others from the edge; necks along faces shift their ends as they
// are turned.
TEST_CASE("tetrahedra and cylinders are joined to closed bodies by necks of any width", "[slow]") {
  const Box walls{4, 3, Boundary::walls, Boundary::walls};
  for (const ShapeSpec& shape : {ShapeSpec(TetrahedronSize{}), ShapeSpec(CylinderSize{})}) {
    const ExportedBed bed = packed_bed(shape, walls, 60);
    for (const char* treatment : {"bridge:0.1", "bridge:0.2", "bridge:0.3"}) {
      const auto bodies = bridged_surfaces(bridged(bed, treatment));
      REQUIRE_FALSE(bodies.empty());
      for (const GrainSurface& body : bodies) CHECK(is_closed(body.surface));
    }
  }
}

TEST_CASE("caps that leave nothing of a grain are refused") {
  const Box walls{4, 3, Boundary::walls, Boundary::walls};
  CuboidSize plate;
  plate.height = 0.2;
  const ExportedBed bed = packed_bed(plate, walls, 60);
  CHECK_THROWS_WITH(grain_surfaces(bridged(bed, "cap:0.6")), Catch::Contains("leave nothing of"));
  CHECK_NOTHROW(grain_surfaces(bridged(bed, "cap:0.2")));
}

TEST_CASE("a cube on another has a neck of the radius asked for in the middle of their contact") {
  const ExportedBed exported = bridged(stacked_cubes());
  const OpenSurfaces open = open_polyhedra(exported);
  REQUIRE(open.necks.size() == 1);
  CHECK(open.necks[0].radius == Approx(0.1).epsilon(1e-12));
  CHECK((open.necks[0].middle - Vector(0.125, 0, 0)).norm() < 1e-12);
  const auto surfaces = bridged_surfaces(exported);
  REQUIRE(surfaces.size() == 1);
  CHECK(euler_characteristic(surfaces[0].surface) == 2);
  // Three caps of 1 d^2 are cut off, and a prism of 12 sides, 3 of its radius squared, fills two.
  const double depth = (1 - std::sqrt(1 - 0.2 * 0.2)) * 0.5;
  CHECK(volume_of(surfaces[0].surface) ==
        Approx(2 - 3 * depth + 2 * depth * 3 * 0.01).epsilon(1e-9));
}

TEST_CASE("across a periodic side grains have flat ends, or images that are joined") {
  ExportedBed exported = bridged(stacked_spheres());
  const double x = 0.6, y = std::sqrt(1 - x * x);
  exported.bed.grains[1].x = 0.1 - x + 4;
  exported.bed.grains[1].y = 0.1 - y + 4;
  const auto apart = bridged_surfaces(exported);
  REQUIRE(apart.size() == 2);
  for (const GrainSurface& body : apart) CHECK(is_closed(body.surface));
  exported.settings.periodic_images = true;
  const auto images = bridged_surfaces(exported);
  CHECK(crossings(images) == 0);
  int joined = 0;
  for (const GrainSurface& body : images) {
    CHECK(is_closed(body.surface));
    CHECK(euler_characteristic(body.surface) == 2);
    joined += body.grains == 2;
  }
  // Where the neck is within the box, over its corner, it joins; where both sides see it, twice.
  CHECK(joined >= 1);
}

TEST_CASE("grains are joined across each side of a box that is longer than wide") {
  for (const bool is_along_x : {true, false}) {
    ExportedBed exported = bridged(empty_box(9, 4, 0));
    exported.settings.periodic_images = true;
    exported.bed.grains = {{0.3, 0.3, 0.5, 0.5, 0, 1}, {0.3, 0.3, 0.5, 0.5, 0, 1}};
    (is_along_x ? exported.bed.grains[1].x : exported.bed.grains[1].y) += is_along_x ? 8 : 3;
    const auto images = bridged_surfaces(exported);
    int joined = 0;
    for (const GrainSurface& body : images) joined += body.grains >= 2;
    CHECK(joined >= 1);
    CHECK(crossings(images) == 0);
  }
}

TEST_CASE("a body is called by the first of its grains, and bodies follow one another so") {
  ExportedBed exported = bridged(empty_box(6, 6, 0));
  exported.bed.grains = {
      {1, 1, 2, 0.5, 0, 0}, {4, 4, 2, 0.5, 0, 0}, {4, 4, 3, 0.5, 0, 0}, {1, 1, 3, 0.5, 0, 0}};
  const auto bodies = bridged_surfaces(exported);
  REQUIRE(bodies.size() == 2);
  CHECK((bodies[0].grain == 0 && bodies[1].grain == 1));
  CHECK((bodies[0].grains == 2 && bodies[1].grains == 2));
}

// Three spheres that touch each other have contacts 60 degrees apart. Necks of a share s take
// 2 asin(s) between them, and keep a tenth of that free: 53.5 degrees leave it, 55.6 do not.
TEST_CASE("necks on a sphere keep a tenth of their width between each other") {
  ExportedBed exported = empty_box(6, 6, 0);
  exported.bed.grains = {
      {2, 2, 2, 0.5, 0, 0}, {3, 2, 2, 0.5, 0, 0}, {2.5, 2 + std::sqrt(0.75), 2, 0.5, 0, 0}};
  for (const bool is_narrow : {true, false}) {
    const auto open = open_spheres(bridged(exported, is_narrow ? "bridge:0.45" : "bridge:0.466"));
    REQUIRE(open.necks.size() == 3);
    for (const Neck& neck : open.necks) CHECK((neck.radius == neck.asked) == is_narrow);
  }
}

// The circle where it ends, so far from the wall, lies within it: its axis does.
TEST_CASE("a sphere that fills a tube has an end all around") {
  ExportedBed exported;
  exported.bed.box = tube_of(1.02);
  exported.bed.grains = {{0.5, 0.51, 2, 0.5, 0, 0}};
  const auto bodies = bridged_surfaces(bridged(exported, "bridge:0.6"));
  REQUIRE(bodies.size() == 1);
  CHECK(is_closed(bodies[0].surface));
  CHECK(euler_characteristic(bodies[0].surface) == 2);
  double widest = 0.0, lowest = 9.0;
  for (const Vector& v : bodies[0].surface.vertices) {
    REQUIRE(v.allFinite());
    widest = std::max(widest, std::hypot(v.x() - 0.51, v.y() - 0.51));
    lowest = std::min(lowest, v.z());
  }
  CHECK(widest == Approx(0.51 - cap_depth(0.6) * 0.5).epsilon(1e-9));
  CHECK(lowest < 1.51);
}

TEST_CASE("periodic beds of cubes with images are closed and cross nowhere") {
  ExportedBed bed = bridged(packed_bed(CubeSize{}, {4, 4, Boundary::periodic, Boundary::periodic},
                                       testing::is_sanitized ? 25 : 40));
  bed.settings.periodic_images = true;
  const auto surfaces = bridged_surfaces(bed);
  for (const GrainSurface& body : surfaces) CHECK(is_closed(body.surface));
  CHECK(crossings(surfaces) == 0);
}

}  // namespace
}  // namespace grainsweep
