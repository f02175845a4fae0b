#include <string>

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
                 Catch::Contains(" -0.5 -0.5 -0.5\n0.5 -0.5 -0.5 -0.5 0.5 -0.5 0.5 0.5 -0.5\n") &&
                 Catch::EndsWith("\n0 2 3 1 4 5 7 6 0\n1 5 4 2 6 7 3 0 4\n6 2 1 3 7 5 1e-09\n"));
}

}  // namespace
}  // namespace grainsweep
