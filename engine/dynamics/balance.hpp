// Static balance: can the closed contacts carry the bed?
//
// Of all forces f >= 0 on the contacts with a gap below a tolerance, those that balance the weight
// w best minimise |M^-1/2 (H f - w)|^2. What they leave is unique, even where the forces are not,
// and has a meaning: by Gauss's principle of least constraint M^-1 (H f - w) are the accelerations
// with which the grains would start to move if they were let go at rest. In a bed at rest there are
// none.
//
// Part of a bed may stand on nothing: no chain of closed contacts, each lifting the next grain,
// joins it to the floor. Whatever the forces are, they can only push it down, and by Newton its
// grains miss balance by its weight. Such beds are recognised without a solve.
//
// It is the problem of a step (engine/dynamics/step.hpp) of grains without motion whose gaps are
// all closed, and the same sweeps solve it, in f64. Forces that are not yet the best ones are still
// f >= 0: the sum of squares of what they leave is an upper bound.
#pragma once

#include "engine/context.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// What the best forces leave on the grains of a bed whose contacts hold the impulses of a step of
/// length `dt`; the search for the best forces starts from these. All pairs and walls with a gap
/// below `tolerance`, d, are contacts, measured anew in f64. For polyhedra torques are balanced,
/// too: what is left of a torque is divided by the grain's circumradius. `closed` is memory. Where
/// so many spheres stand on nothing that the mean must be above `of_interest`, own weights, both
/// numbers are a lower bound of the mean.
template <class Kind, class Real>
Imbalance static_imbalance(double tolerance, double of_interest, const ExecutionContext& context,
                           const Bed<Kind>& bed, double dt, const Contacts<Kind, Real>& contacts,
                           StepState<Kind, double>& closed);

}  // namespace grainsweep
