// What the components of a mixture do in one bed; see ComponentMeasure in engine/results.hpp.
#pragma once

#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/measure/touching.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// An entry for each component; empty if the grains have none. Neighbours are counted as in
/// engine/measure/coordination.hpp, contacts as in engine/measure/shape_order.hpp; solid fractions
/// add up to that of the slab. `lines`: one for each of the forces. Profiles are left empty.
std::vector<ComponentMeasure> measure_components(const PolyhedronBed& bed, const Touching& touching,
                                                 const std::vector<PairForce>& pair_forces,
                                                 const std::vector<ForceLine>& lines,
                                                 const Slab& slab, double gap_tolerance);

}  // namespace grainsweep
