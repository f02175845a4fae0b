// Beds as data files of LAMMPS.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// Spheres in the atom style `sphere`, polyhedra in the style `body rounded/polyhedron`, faces of
/// more than four corners in triangles. Atom types are the size classes. Lengths in d, masses in
/// those of a grain of size 1. The first line says which boundaries to ask for.
std::string lammps_data(const ExportedBed& exported);

}  // namespace grainsweep
