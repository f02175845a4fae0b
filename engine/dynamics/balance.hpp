// Static balance: can the closed contacts carry the bed?
//
// Of all forces f >= 0 on the contacts with a gap below a tolerance, those that balance the weight
// w best minimise |M^-1/2 (H f - w)|^2. What they leave is unique, even where the forces are not,
// and has a meaning: by Gauss's principle of least constraint M^-1 (H f - w) are the accelerations
// with which the grains would start to move if they were let go at rest. In a bed at rest there are
// none.
//
// Part of a bed may stand on nothing: no closed contacts join it to the floor, each lifting the
// next grain. Whatever the forces are, they push it down if anything, and by Newton its grains miss
// balance by its weight. Such beds are known without a solve.
//
// It is the problem of a step (engine/dynamics/step.hpp) of grains without motion whose gaps are
// all closed, and the same sweeps solve it, in f64. Forces that are not yet the best ones push all
// the same: what they leave on the whole, as a sum of squares, is a bound from above.
#pragma once

#include "engine/context.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// What the best forces leave on the grains of a bed whose contacts hold the impulses of a step of
/// length `dt`, from which the search for them starts. All pairs and walls with a gap below
/// `tolerance`, d, are contacts, measured anew in f64. Of polyhedra torques are balanced, too: what
/// is left of one counts over the grain's circumradius. `closed` is memory. Where so many spheres
/// stand on nothing that the mean must be above `of_interest`, own weights, both numbers are what
/// it is at least.
template <class Kind, class Real>
Imbalance static_imbalance(double tolerance, double of_interest, const ExecutionContext& context,
                           const Bed<Kind>& bed, double dt, const Contacts<Kind, Real>& contacts,
                           StepState<Kind, double>& closed);

}  // namespace grainsweep
