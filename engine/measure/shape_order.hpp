// How the polyhedra of a packing touch and point; see ShapeOrder in engine/results.hpp.
#pragma once

#include <vector>

#include "engine/measure/solid_fraction.hpp"
#include "engine/scene/shape_bed.hpp"

namespace grainsweep {

/// Of the forces whose height lies in the slab, and of the grains whose centre does.
ShapeOrder measure_shape_order(const ShapeBed& bed, const std::vector<PairForce>& pair_forces,
                               const Slab& slab);

}  // namespace grainsweep
