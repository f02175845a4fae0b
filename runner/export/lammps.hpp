// Beds as data files of LAMMPS.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// Spheres in the atom style `sphere`, polyhedra in the style `body rounded/polyhedron`, faces of
/// more than four corners split into triangles. Atom types are the size classes. Lengths in d,
/// masses in units of that of a grain of size 1. The first line says which boundaries to ask for.
std::string lammps_data(const ExportedBed& exported);

/// Why LAMMPS cannot read grains of these shapes, with what to take instead; "" if it can.
std::string fault_for_lammps(const StoredBed& bed);

/// Prisms and cylinders with at most so many sides fit into a body of LAMMPS.
inline constexpr int most_sides_for_lammps = 41;

}  // namespace grainsweep
