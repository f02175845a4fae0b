#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/export/contacts.hpp"
#include "tests/runner/export/packed_bed.hpp"
#include "tests/runner/export/touching_beds.hpp"
#include "tests/support/about.hpp"

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

TEST_CASE("a contact that bears a force is of the kind of what is closed, as in the tables") {
  ExportedBed exported = stacked_cubes();
  const double tilt = 0.002;  // the upper cube stands on an edge, 0.0015 d open at the other end
  exported.bed.turned->orientations[1] = {0, -std::sin(tilt / 2), 0, std::cos(tilt / 2)};
  exported.bed.grains[1].z = 1 + 0.5 * (std::sin(tilt) + std::cos(tilt));
  exported.gap_tolerance = 0.006;
  CHECK(contacts_of(exported).at(0).place.constraints == 3);
  exported.bed.forces = {{0, 1, 1.0}};
  const Contact bearing = contacts_of(exported).at(0);
  CHECK(bearing.place.constraints == 2);
  CHECK(bearing.place.point.x() == about(1.75, tilt));  // at the edge
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
    CHECK(force[k] == about(grains[k].force, 1e-12));
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

/// What contacts leave on a grain on the whole.
struct Left {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   // own weights
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // own weights times circumradii
};

std::vector<Left> left_on_grains(const ExportedBed& exported) {
  std::vector<Left> left(exported.bed.grains.size());
  const auto push = [&](std::size_t grain, const Eigen::Vector3d& force,
                        const Eigen::Vector3d& lever) {
    const double radius = exported.bed.grains[grain].radius, weight = std::pow(2 * radius, 3);
    left[grain].force += force / weight;
    left[grain].moment += lever.cross(force) / (weight * radius);
  };
  for (const Contact& contact : contacts_of(exported)) {
    const Eigen::Vector3d lever = contact.place.point - centre_in_box(exported.bed, contact.a);
    const Eigen::Vector3d force = contact.force * contact.place.normal;
    push(contact.a, -force, lever);
    if (contact.is_wall) continue;
    push(contact.b, force, lever - between_centres(exported.bed, contact.a, contact.b));
  }
  for (Left& one : left) one.force.z() -= 1;
  return left;
}

/// What the last step leaves is on the mean what the preset allows.
void check_balance(const ShapeSpec& shape, const Box& box) {
  const ExportedBed exported = packed_bed(shape, box, 90, "balanced");
  const double of_last_step = preset("balanced")->imbalance_tolerance;
  double force = 0, moment = 0;
  const auto left = left_on_grains(exported);
  for (const Left& one : left) force += one.force.norm(), moment += one.moment.norm();
  CHECK(force / static_cast<double>(left.size()) < of_last_step);
  CHECK(moment / static_cast<double>(left.size()) < of_last_step);
}

TEST_CASE("forces of spheres times their normals bear each grain, and turn none") {
  check_balance(SphereShape{}, {4, 3, Boundary::periodic, Boundary::walls});
}

TEST_CASE("forces of polyhedra times their normals bear each grain, and their moments cancel") {
  const Box box = GENERATE(Box{4, 3, Boundary::periodic, Boundary::walls}, tube_of(4));
  const ShapeSpec shape = GENERATE(ShapeSpec(PinacoidSize{}), ShapeSpec(CubeSize{}));
  check_balance(shape, box);
}

TEST_CASE("a force is where its line says, and of its kind, wherever its grains are nearest") {
  ExportedBed exported = stacked_cubes();
  exported.bed.forces = {{0, 1, 1.0}};
  exported.bed.lines = {{{0, 0.6F, 0.8F}, {0.25F, 0.125F, 0.5F}, 2}};
  const Contact contact = contacts_of(exported).at(0);
  CHECK(contact.place.constraints == 2);
  CHECK(contact.place.normal.isApprox(Eigen::Vector3d(0, 0.6, 0.8), 1e-7));  // a float's rounding
  CHECK(contact.place.point == centre_in_box(exported.bed, 0) + Eigen::Vector3d(0.25, 0.125, 0.5));
}

}  // namespace
}  // namespace grainsweep
