// The surfaces of a bed as files for meshers and for drawing. Lengths in d.
#pragma once

#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// STL in text: a solid per grain, closed, "grain_<id>_<size class>", or per body of grains that
/// necks join, "joined_<lowest id>", and a last one, "container", which ends 0.1 d above the
/// highest grain. Its normals point outwards, those of the container away from the grains.
std::string surfaces_stl(const ExportedBed& exported);

/// OBJ with the same surfaces as objects; spheres and polyhedra keep their polygons.
std::string surfaces_obj(const ExportedBed& exported);

}  // namespace grainsweep
