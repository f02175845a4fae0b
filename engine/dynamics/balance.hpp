// Force balance by a direct solve: can the final contacts carry the bed, and in one way only?
//
// The forces f that balance the weight best minimise |M^-1/2 (H f - w)|^2 over the force-bearing
// contacts. Their normal equations A f = H^T M^-1 w with A = H^T M^-1 H are solved by sparse
// Cholesky factors, independent of how the bed was settled. In a bed at rest all forces push, no
// grain is left unbalanced, and A is regular: with as many contacts as degrees of freedom the
// forces follow from the geometry alone.
#pragma once

#include "engine/context.hpp"
#include "engine/results.hpp"
#include "engine/rows/polyhedron_contacts.hpp"
#include "engine/rows/sphere_contacts.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Balances the force-bearing contacts of a bed whose contacts hold the impulses of a step of
/// length `dt`; normals and points are measured anew in f64. Of polyhedra torques are balanced,
/// too: what is left of one counts over the grain's circumradius, and a contact's force is the sum
/// over its points.
template <class Kind, class Real>
ForceBalance balance_forces(Bed<Kind>& bed, const ExecutionContext& context, double dt,
                            const Contacts<Kind, Real>& contacts);

}  // namespace grainsweep
