#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "runner/export/lammps.hpp"
#include "tests/runner/export/touching_beds.hpp"

namespace grainsweep {
namespace {

TEST_CASE(
    "LAMMPS data of spheres: box, types by size class, diameters, and masses of 1 at size 1") {
  ExportedBed exported = stacked_spheres();
  exported.small_limit = 0.3;
  exported.bed.grains[1].radius = 0.25;
  CHECK(lammps_data(exported) ==
        "grainsweep, lengths in d; atom_style sphere; boundary p p f\n\n2 atoms\n2 atom types\n\n"
        "0 4 xlo xhi\n0 4 ylo yhi\n0 1 zlo zhi\n\nAtoms # sphere\n\n"
        "1 1 1 1.909859317102744 0.1 0.1 0.5\n2 2 0.5 1.909859317102744 0.7 0.9 0.5\n");
}

TEST_CASE("LAMMPS data of polyhedra: bodies with moments of inertia, corners, edges and faces") {
  ExportedBed exported = stacked_cubes();
  exported.bed.grains.resize(1);
  exported.bed.turned->orientations.resize(1);
  const std::string text = lammps_data(exported);
  CHECK_THAT(text,
             Catch::Contains("1 atoms\n1 bodies\n") &&
                 Catch::Contains("Atoms # body\n\n1 1 1 1 2 2 0.5\n\nBodies\n\n1 3 79\n"
                                 "8 12 6\n0.16666666666666") &&
                 Catch::Contains(" -0.5 -0.5 -0.5 0.5 -0.5 -0.5 -0.5 0.5 -0.5 0.5 0.5 -0.5 ") &&
                 Catch::EndsWith(" 0 2 3 1 4 5 7 6 0 1 5 4 2 6 7 3\n0 4 6 2 1 3 7 5 1e-09\n"));
}

TEST_CASE("LAMMPS data of a turned cuboid: its moments of inertia in the box's frame") {
  ExportedBed exported = stacked_cubes();
  exported.bed.grains.resize(1);
  const Eigen::Vector3d sides(1, 0.5, 0.25);
  for (auto& [x, y, z] : exported.bed.turned->meshes.front().vertices) {
    x *= sides.x(), y *= sides.y(), z *= sides.z();
  }
  const Eigen::Quaterniond turn(0.5, 0.1, 0.3, std::sqrt(0.65));
  exported.bed.turned->orientations = {{turn.x(), turn.y(), turn.z(), turn.w()}};
  // Of a mass of 1.
  const Eigen::Vector3d squares = sides.cwiseAbs2();
  const Eigen::Vector3d principal = (Eigen::Vector3d::Constant(squares.sum()) - squares) / 12;
  const Eigen::Matrix3d rotation = turn.toRotationMatrix();
  const Eigen::Matrix3d inertia = rotation * principal.asDiagonal() * rotation.transpose();
  const std::string text = lammps_data(exported);
  const std::string counts = "\n8 12 6\n";
  std::istringstream words(text.substr(text.find(counts) + counts.size()));
  for (const auto& [row, column] : {std::pair(0, 0), std::pair(1, 1), std::pair(2, 2),
                                    std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
    double moment = 0;
    words >> moment;
    CHECK(moment == Approx(inertia(row, column)).margin(1e-15));
  }
}

/// A prism of that many sides, turned so that its coordinates have all their digits.
ExportedBed lying_prism(int sides) {
  ExportedBed exported = stacked_cubes();
  exported.bed.grains.resize(1);
  exported.bed.turned->orientations = {{0.1, 0.3, std::sqrt(0.65), 0.5}};
  Mesh& mesh = exported.bed.turned->meshes.front();
  mesh = {};
  mesh.faces.resize(2);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    for (const double z : {-0.5, 0.5}) {
      mesh.vertices.push_back({std::cos(angle) / 2, std::sin(angle) / 2, z});
    }
    const int next = (k + 1) % sides;
    mesh.faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
    mesh.faces[0].insert(mesh.faces[0].begin(), 2 * k);
    mesh.faces[1].push_back(2 * k + 1);
  }
  return exported;
}

TEST_CASE("a body of LAMMPS has no more lines and characters than LAMMPS reads") {
  for (const int sides : {12, 32, most_sides_for_lammps}) {
    INFO(sides << " sides");
    const ExportedBed exported = lying_prism(sides);
    CHECK(fault_for_lammps(exported.bed).empty());
    std::istringstream text(lammps_data(exported));
    std::string line;
    while (line != "Bodies") std::getline(text, line);
    std::getline(text, line);
    int lines = 0;
    for (; std::getline(text, line); ++lines) CHECK(line.size() < 255);
    CHECK(lines <= 32);
  }
}

// It has 9 numbers of each: 3 of a corner, 2 of an edge, 4 of a face.
TEST_CASE("LAMMPS is asked for as many corners as it needs to make room for edges and faces") {
  CHECK_THAT(lammps_data(lying_prism(12)), Catch::Contains("body rounded/polyhedron 3 64;"));
  CHECK_THAT(lammps_data(lying_prism(32)), Catch::Contains("body rounded/polyhedron 3 84;"));
}

TEST_CASE("shapes of more corners than LAMMPS reads are refused with what to take instead") {
  CHECK_THAT(fault_for_lammps(lying_prism(44).bed),
             Catch::Contains("88 corners") && Catch::Contains("up to 41 sides"));
  CHECK(fault_for_lammps(stacked_spheres().bed).empty());
}

}  // namespace
}  // namespace grainsweep
