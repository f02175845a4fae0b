// How many constraints of a bed are independent of each other.
//
// Where faces lie flat on each other, contacts bring more constraints than grains have degrees of
// freedom: their number alone does not say whether enough of them are where they are needed. The
// rank of H does; H is the matrix of the forces that unit forces of the contacts put on the grains.
#pragma once

#include <cstdint>

#include "engine/context.hpp"
#include "engine/rows/polyhedron_contacts.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Rank of the force-bearing constraints of a bed whose contacts hold the impulses of a step of
/// length `dt`; normals and points are measured anew in f64. A contact of polyhedra is a constraint
/// at a point, two along a line, three over an area; constraints that depend on others to within a
/// share of 1e-5 are not counted.
template <class Kind, class Real>
std::int64_t independent_constraints(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                                     const Contacts<Kind, Real>& contacts);

}  // namespace grainsweep
