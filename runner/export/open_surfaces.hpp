// Surfaces of grains with a hole for each neck. Lengths in d.
#pragma once

#include <vector>

#include "runner/export/necks.hpp"
#include "runner/export/surfaces.hpp"
#include "runner/export/triangles.hpp"

namespace grainsweep {

/// Where a neck begins or ends on a grain.
struct Hole {
  std::size_t neck = 0;
  std::vector<Loop> sides;  ///< corners of the rim from corner k of the neck up to the next one
  std::vector<Loop> lid;    ///< the faces that close it where the neck is left out
};

struct OpenSurface {
  Surface surface;  ///< without its lids
  std::vector<Hole> holes;
};

/// All necks of a bed, and the surfaces of its grains about their centres with holes for them.
struct OpenSurfaces {
  std::vector<Neck> necks;  ///< between grains
  std::vector<OpenSurface> grains;
};

/// For spheres: necks end in circles of their radius on both, and flat places remain at walls.
OpenSurfaces open_spheres(const ExportedBed& exported);

/// For polyhedra: caps are cut off at every contact first, as by cut_caps; a neck is a column about
/// the normal that ends where it meets what is left of the two.
OpenSurfaces open_polyhedra(const ExportedBed& exported);

/// A convex polyhedron about its centre with holes for the ends of necks, columns that lie apart
/// and within its outline.
OpenSurface with_holes(const Surface& convex, const std::vector<NeckEnd>& columns);

}  // namespace grainsweep
