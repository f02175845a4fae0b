#include <algorithm>
#include <cmath>
#include <utility>

#include <catch2/catch.hpp>

#include "engine/units.hpp"
#include "runner/export/bridges.hpp"
#include "runner/export/caps.hpp"
#include "runner/export/contacts.hpp"
#include "runner/export/surfaces.hpp"
#include "tests/runner/export/closed_surfaces.hpp"
#include "tests/runner/export/packed_bed.hpp"
#include "tests/runner/export/touching_beds.hpp"
#include "tests/support/about.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

double reach_along(const Surface& surface, const Vector& normal) {
  double reach = -1e9;
  for (const Vector& vertex : surface.vertices) reach = std::max(reach, normal.dot(vertex));
  return reach;
}

TEST_CASE("a ball is closed, its corners lie on it, and finer ones are fuller") {
  double before = 0.0;
  for (int divisions = 0; divisions < 4; ++divisions) {
    const Surface ball = unit_ball(divisions);
    CHECK(ball.faces.size() == 20u << (2 * divisions));
    CHECK(is_closed(ball));
    for (const Vector& vertex : ball.vertices) CHECK(vertex.norm() == Approx(1).epsilon(1e-15));
    CHECK(volume_of(ball) > before);
    before = volume_of(ball);
  }
  CHECK(before / sphere_volume(1) == about(1, 0.01));
}

TEST_CASE("spheres with flat ends or necks are of 1280 triangles, others of 320") {
  ExportedBed bed = packed_bed(SphereShape{}, {3, 3, Boundary::walls, Boundary::walls}, 3);
  const std::pair<const char*, std::size_t> expected[] = {
      {"shrink:0.9", 320}, {"cap:0.2", 1280}, {"bridge:0.2", 1280}};
  for (const auto& [treatment, faces] : expected) {
    INFO(treatment);
    bed.settings.treatment = *contact_treatment(treatment);
    for (const Surface& surface : whole_surfaces(bed)) CHECK(surface.faces.size() == faces);
  }
}

TEST_CASE("a cut leaves a closed surface of what lies below the plane") {
  const Surface cube = container_surface(empty_box(2, 2, 2).bed.box, 2);
  CHECK(volume_of(cube) == 8);
  const Surface half = cut_off(cube, {0, 0, 1}, 1.5);
  CHECK(is_closed(half));
  CHECK(volume_of(half) == Approx(6).epsilon(1e-15));
  const Vector diagonal = Vector(1, 1, 1).normalized();
  const Surface corner = cut_off(cube, diagonal, 1.0 / std::sqrt(3.0));
  CHECK(is_closed(corner));
  CHECK(volume_of(corner) == Approx(1.0 / 6.0).epsilon(1e-14));
  CHECK(cut_off(cube, diagonal, 10).faces == cube.faces);
  CHECK(cut_off(cube, diagonal, -0.1).faces.empty());
}

TEST_CASE("a ball cut many times stays closed") {
  Surface ball = unit_ball(3);
  for (int k = 0; k < 40; ++k) {
    const Vector normal = Vector(std::sin(1.7 * k), std::cos(2.3 * k), std::sin(0.9 * k + 1));
    ball = cut_off(ball, normal.normalized(), 0.96);
    REQUIRE(is_closed(ball));
  }
  CHECK(volume_of(ball) < volume_of(unit_ball(3)));
}

TEST_CASE("shrunk grains keep their share of each length") {
  ExportedBed exported = stacked_spheres();
  const double whole = volume_of(grain_surfaces(exported)[0].surface);
  exported.settings.treatment = *contact_treatment("shrink:0.5");
  CHECK(volume_of(grain_surfaces(exported)[0].surface) == Approx(whole / 8).epsilon(1e-12));
}

/// How far treated grains and the container are apart along the normals of their contacts; each is
/// convex, so that they do not meet.
double least_way_apart(const ExportedBed& exported) {
  const auto surfaces = grain_surfaces(exported);
  double least = 1e9;
  for (const Contact& contact : contacts_of(exported)) {
    const Vector& n = contact.place.normal;
    const double end = contact.is_wall ? -n.dot(contact.place.point) - contact.gap / 2.0
                                       : reach_along(surfaces[contact.b].surface, -n);
    least = std::min(least, -end - reach_along(surfaces[contact.a].surface, n));
  }
  return least;
}

TEST_CASE("caps leave grains apart by two of their depths, and from walls by one") {
  for (ExportedBed exported : {stacked_spheres(), stacked_cubes()}) {
    CHECK(least_way_apart(exported) < 1e-6);
    exported.settings.treatment = *contact_treatment("cap:0.2");
    const double depth = (1 - std::sqrt(1 - 0.2 * 0.2)) * exported.bed.grains[0].radius;
    CHECK(least_way_apart(exported) == Approx(depth).epsilon(0.01));
    for (const GrainSurface& grain : grain_surfaces(exported)) CHECK(is_closed(grain.surface));
    exported.settings.treatment = *contact_treatment("shrink:0.99");
    CHECK(least_way_apart(exported) > 0.004);
  }
}

TEST_CASE("caps leave grains apart that overlap by more than them, and those in a wall") {
  for (ExportedBed exported : {stacked_spheres(), stacked_cubes()}) {
    exported.settings.treatment = *contact_treatment("cap:0.2");
    const double depth = cap_depth(0.2) * exported.bed.grains[0].radius;
    double sunk = 0.0;
    for (SettledGrain& grain : exported.bed.grains) {
      sunk += 3.0 * depth;
      grain.z -= sunk;
    }
    CHECK(least_way_apart(exported) == Approx(depth).epsilon(0.01));
    for (const GrainSurface& grain : grain_surfaces(exported)) CHECK(is_closed(grain.surface));
  }
}

std::vector<GrainSurface> treated_surfaces(const ExportedBed& exported) {
  const bool joins = exported.settings.treatment.kind == ContactTreatment::Kind::bridge;
  return joins ? bridged_surfaces(exported) : grain_surfaces(exported);
}

/// How near to the wall of a tube the corners of the treated grains come.
double gap_of_tube(const ExportedBed& exported, const std::vector<GrainSurface>& surfaces) {
  const double radius = exported.bed.box.width / 2.0;
  double least = radius;
  for (const GrainSurface& grain : surfaces) {
    for (const Vector& corner : grain.surface.vertices) {
      least = std::min(least, radius - std::hypot(corner.x() - radius, corner.y() - radius));
    }
  }
  return least;
}

double smallest_cap_depth(const ExportedBed& exported) {
  double radius = 1.0;
  for (const SettledGrain& grain : exported.bed.grains) radius = std::min(radius, grain.radius);
  return cap_depth(0.2) * radius;
}

/// Two boxes, one on the other, whose top and bottom end in slopes so low.
ExportedBed sloped_boxes(double slope) {
  ExportedBed exported = stacked_cubes();
  exported.bed.grains[1].x = exported.bed.grains[0].x;
  Mesh& mesh = exported.bed.turned->meshes.front();
  mesh = {};
  for (const auto& [half, z] : {std::pair(0.3, 0.5), std::pair(0.5, 0.5 - slope),
                                std::pair(0.5, slope - 0.5), std::pair(0.3, -0.5)}) {
    for (const int corner : {0, 1, 3, 2}) {  // counter-clockwise
      mesh.vertices.push_back({corner & 1 ? half : -half, corner & 2 ? half : -half, z});
    }
  }
  mesh.faces = {{0, 1, 2, 3}, {15, 14, 13, 12}};
  for (std::int32_t upper = 0; upper < 12; upper += 4) {
    for (std::int32_t k = 0; k < 4; ++k) {
      const std::int32_t next = (k + 1) % 4;
      mesh.faces.push_back({upper + 4 + k, upper + 4 + next, upper + next, upper + k});
    }
  }
  return exported;
}

// A cap that ended within 1e-3 of a radius from corners would leave slivers: it ends below them.
TEST_CASE("caps keep clear of the corners of a grain") {
  const double depth = cap_depth(0.2) * 0.5, clearance = 1e-3 * 0.5;
  for (const double beyond : {-2e-3, -1e-5, 1e-5, 2e-3}) {
    ExportedBed exported = sloped_boxes(depth + beyond);
    exported.settings.treatment = *contact_treatment("cap:0.2");
    const auto surfaces = grain_surfaces(exported);
    double top = 0;
    for (const Vector& v : surfaces.at(0).surface.vertices) top = std::max(top, v.z());
    const bool is_near = std::abs(beyond) < clearance;
    CHECK(top == Approx(1.0 - (is_near ? depth + beyond + clearance : depth)).epsilon(1e-12));
    CHECK(is_closed(surfaces[0].surface));
  }
}

TEST_CASE("caps and necks leave the depth of a cap at the wall of a tube, however narrow") {
  const double diameters[] = {1.5, 1.0, 1.05, 2.5};
  for (int k = 0; k < testing::tries(4); ++k) {
    const double diameter = diameters[k];
    ExportedBed exported = packed_bed(SphereShape{}, tube_of(diameter), 12);
    const double depth = smallest_cap_depth(exported);
    CHECK(gap_of_tube(exported, grain_surfaces(exported)) < 0.3 * depth);  // balls have corners
    for (const char* treatment : {"cap:0.2", "bridge:0.2"}) {
      exported.settings.treatment = *contact_treatment(treatment);
      const auto surfaces = treated_surfaces(exported);
      const double gap = gap_of_tube(exported, surfaces);
      // Sides of a prism lie within the circle by an eighth of the depth at most, overlaps are 1e-4
      // d.
      CAPTURE(diameter, treatment, gap, depth);
      CHECK((gap > 0.98 * depth && gap < 1.2 * depth));
      for (const GrainSurface& grain : surfaces) CHECK(is_closed(grain.surface));
      CHECK(crossings(surfaces) == 0);
    }
  }
}

TEST_CASE("polyhedra keep the depth of a cap before the wall of a tube") {
  ExportedBed exported = packed_bed(CubeSize{}, tube_of(3), 20);
  CHECK(gap_of_tube(exported, grain_surfaces(exported)) < 1e-3);
  for (const char* treatment : {"cap:0.2", "bridge:0.2"}) {
    exported.settings.treatment = *contact_treatment(treatment);
    const auto surfaces = treated_surfaces(exported);
    CHECK(gap_of_tube(exported, surfaces) > 0.98 * smallest_cap_depth(exported));
    for (const GrainSurface& grain : surfaces) CHECK(is_closed(grain.surface));
    CHECK(crossings(surfaces) == 0);
  }
}

TEST_CASE("grains that cross a periodic side have an image beyond the other one") {
  ExportedBed exported = stacked_spheres();  // one over a corner of the periodic box
  CHECK(grain_surfaces(exported).size() == 2);
  exported.settings.periodic_images = true;
  const auto surfaces = grain_surfaces(exported);
  REQUIRE(surfaces.size() == 5);
  CHECK(std::count_if(surfaces.begin(), surfaces.end(),
                      [](const GrainSurface& grain) { return grain.grain == 0; }) == 4);
  for (SettledGrain& grain : exported.bed.grains) grain.x = 4 - grain.x, grain.y = 4 - grain.y;
  CHECK(grain_surfaces(exported).size() == 5);  // the other corner
}

TEST_CASE("a tube's surface holds the tube and hardly more") {
  ExportedBed exported = stacked_spheres();
  exported.bed.box = tube_of(4);
  const Surface tube = container_surface(exported.bed.box, height_of(exported.bed));
  CHECK(is_closed(tube));
  const double whole = pi * 4 * height_of(exported.bed);
  CHECK((volume_of(tube) > whole && volume_of(tube) < 1.001 * whole));
}

TEST_CASE("each face of a container has its part, floor and top last") {
  for (const Box& box : {tube_of(4), empty_box(2, 3, 2).bed.box}) {
    const Surface surface = container_surface(box, 5);
    const std::vector<std::string> parts = container_parts(box);
    REQUIRE(parts.size() == surface.faces.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const auto is_at = [&](double z) {
        return std::all_of(surface.faces[k].begin(), surface.faces[k].end(),
                           [&](std::int32_t v) { return corner(surface, v).z() == z; });
      };
      CHECK(is_at(0) == (parts[k] == "container_floor"));
      CHECK(is_at(5) == (parts[k] == "container_top"));
    }
  }
}

TEST_CASE("treatments are read with a share below 1") {
  CHECK(contact_treatment("shrink:.99")->share == 0.99);
  CHECK(contact_treatment("cap:0.2")->kind == ContactTreatment::Kind::cap);
  CHECK(contact_treatment("bridge:0.2")->kind == ContactTreatment::Kind::bridge);
  for (const char* text :
       {"", "cap", "cap:", "cap:1", "cap:0", "shrink:-1", "weld:0.2", "cap:.2x"}) {
    CHECK_FALSE(contact_treatment(text));
  }
  CHECK(contact_treatment("cap:0.001"));
  CHECK(contact_treatment("shrink:1e-5"));
  for (const char* text : {"cap:0.0009", "bridge:1e-5"}) CHECK_FALSE(contact_treatment(text));
}

}  // namespace
}  // namespace grainsweep
