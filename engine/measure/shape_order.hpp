// How the polyhedra of a packing touch and point; see ShapeOrder in engine/results.hpp.
#pragma once

#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Of the forces whose height lies in the slab, and of the grains whose centre does. `lines`: one
/// for each of the forces.
ShapeOrder measure_shape_order(const PolyhedronBed& bed, const std::vector<PairForce>& pair_forces,
                               const std::vector<ForceLine>& lines, const Slab& slab);

}  // namespace grainsweep
