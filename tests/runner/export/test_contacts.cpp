#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/export/contacts.hpp"
#include "tests/runner/export/packed_bed.hpp"

namespace grainsweep {
namespace {

/// Two grains that touch across the periodic side x, one of them the floor and a wall.
ExportedBed two_that_touch() {
  StoredBed bed;
  bed.box = {6, 4, Boundary::periodic, Boundary::walls};
  bed.grains = {{5.75, 0.5, 0.5, 0.5, 3, 1}, {0.5, 0.5, 0.5, 0.25, 1, 1}};
  bed.forces = {{0, 1, 0.125}};
  bed.wall_forces = {{0, 0, 1.0 / 3.0}};
  return {bed, 0.3, 1e-4};
}

TEST_CASE("contacts are listed with ids, classes, kind, gap, normal, point and force") {
  CHECK(contacts_csv(two_that_touch()) ==
        "a,b,wall,size_class_a,size_class_b,kind,gap,nx,ny,nz,x,y,z,force\n"
        "1,2,,large,small,point,0,1,0,0,6.25,0.5,0.5,0.125\n"
        "1,,floor,large,,point,0,-0,-0,-1,5.75,0.5,0,0.3333333333333333\n"
        "1,,y_low,large,,point,0,-0,-1,-0,5.75,0,0.5,0\n");
}

TEST_CASE("lines of contacts leave the box where they cross its periodic side") {
  const std::string text = contacts_vtp(two_that_touch());
  CHECK_THAT(text,
             Catch::Contains("NumberOfPoints=\"6\" NumberOfVerts=\"0\" NumberOfLines=\"3\"") &&
                 Catch::Contains("\n5.75 0.5 0.5\n6.5 0.5 0.5\n") &&
                 Catch::Contains("Name=\"b\" format=\"ascii\">\n2\n0\n0\n"));
}

TEST_CASE("a pair with a force is listed whatever its gap, another one only if it touches") {
  ExportedBed exported = two_that_touch();
  exported.bed.grains[1].x += 0.01;
  CHECK(contacts_of(exported).size() == 3);
  exported.bed.forces.clear();
  CHECK(contacts_of(exported).size() == 2);
}

TEST_CASE("walls are called by their side, or tube") {
  const Box box{6, 4, Boundary::periodic, Boundary::walls};
  CHECK(wall_name(box, 0) == "floor");
  CHECK(wall_name(box, 1) == "y_low");
  CHECK(wall_name({6, 4, Boundary::walls, Boundary::walls}, 2) == "x_high");
  CHECK(wall_name({6, 4, Boundary::walls, Boundary::walls}, 4) == "y_high");
  CHECK(wall_name(tube_of(4), 1) == "tube");
}

/// Forces and neighbours of every grain, added up over the contacts.
void check_sums(const ExportedBed& exported) {
  const auto& grains = exported.bed.grains;
  std::vector<double> force(grains.size());
  std::vector<int> touching(grains.size());
  for (const Contact& contact : contacts_of(exported)) {
    CHECK(contact.place.normal.norm() == Approx(1).epsilon(1e-12));
    const bool touches = contact.gap < exported.gap_tolerance;
    force[contact.a] += contact.force;
    if (contact.is_wall) continue;
    force[contact.b] += contact.force;
    touching[contact.a] += touches;
    touching[contact.b] += touches;
  }
  for (std::size_t k = 0; k < grains.size(); ++k) {
    CHECK(touching[k] == grains[k].touching);
    CHECK(force[k] == Approx(grains[k].force).margin(1e-12));
  }
}

TEST_CASE("contacts of spheres add up to the neighbours and forces that each grain has") {
  check_sums(packed_bed(SphereShape{}, {4, 3, Boundary::periodic, Boundary::walls}, 90));
}

TEST_CASE("contacts of polyhedra add up to the neighbours and forces that each grain has") {
  const Box box{4, 3, Boundary::periodic, Boundary::walls};
  check_sums(packed_bed(PinacoidSize{}, box, 90));
}

TEST_CASE("contacts of polyhedra in a tube add up, though they touch its wall in many places") {
  check_sums(packed_bed(PinacoidSize{}, tube_of(4), 90));
}

}  // namespace
}  // namespace grainsweep
