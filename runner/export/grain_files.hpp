// The grains of a bed in formats that other programs read. Lengths in those of the settings, forces
// in m g.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// id, size_class, x, y, z, radius, force, coordination: a grain per line. For grains that are no
/// spheres also qx, qy, qz, qw, the unit quaternion from the shape's frame to the box's.
std::string grains_csv(const ExportedBed& in_d);

/// Extended XYZ, for OVITO and ASE: the box as Lattice (its height is the bed's), periodic axes as
/// pbc, a grain per line with species (X: none of the elements), pos, id, size_class, radius,
/// coordination, force, and orientation (x, y, z, w) of grains that are no spheres.
std::string grains_xyz(const ExportedBed& in_d);

/// VTK XML PolyData, for ParaView. Spheres as points with the arrays id, size_class, radius,
/// coordination, force; other grains as the polygons of their faces, each with the arrays of its
/// grain and size in place of radius.
std::string grains_vtp(const ExportedBed& exported);

}  // namespace grainsweep
