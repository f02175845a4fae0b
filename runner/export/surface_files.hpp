// The surfaces of a bed as files for meshers and for drawing. Lengths in those of
// the settings.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// Binary STL: the triangles of every grain, or of every body of grains that necks join, each a
/// closed surface, and last those of the container, which ends 0.1 d above the highest grain. Their
/// normals point outwards, those of the container away from the grains. The two bytes that end each
/// triangle are the id of the grain, or the lowest id of those joined, 65535 at most; 0 for the
/// container.
std::string surfaces_stl(const ExportedBed& exported);

/// OBJ with the same surfaces as objects, "grain_<id>_<size class>", "joined_<lowest id>" and
/// "container"; spheres and polyhedra keep their polygons.
std::string surfaces_obj(const ExportedBed& exported);

}  // namespace grainsweep
