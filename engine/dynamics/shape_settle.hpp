// From a bed of grains that turn, in the air, to one at rest, in four stages.
//
//   fall    full steps with momentum, solved loosely, until the floor carries the bed and it has
//           lost its speed; overlaps of the start are repaired by 20 % a step
//   creep   full steps, solved a little better: grains slide into their places. As with spheres,
//           more steps of loose solves reach more contacts than fewer of good ones
//   slow    half steps; the step must not be shortened to a quarter at once, which leaves motions
//           that take many short steps to die
//   quench  quarter steps without momentum: contacts close, until every test of rest holds
//
// How loosely the fall is solved is part of how a bed was packed: fewer iterations act like tapping
// and pack pinacoids denser, by .008 in solid fraction from 100 iterations to 40.
#pragma once

#include "engine/dynamics/settle.hpp"
#include "engine/dynamics/shape_step.hpp"

namespace grainsweep {

/// Gap up to which a point of contact counts as a constraint, d.
inline constexpr double constraint_gap = 1e-4;

/// How far from rest the bed is, after a step of length `dt`. Contacts are measured anew where the
/// grains are now. As `contacts` it counts the constraints of contacts that bear a force (a point
/// 1, a line 2, an area 3), which are isostatic at six for each grain less what slides freely: the
/// bed as one along each periodic axis, and grains alone on the floor, which also turn. Overlaps
/// are those of the deepest points of these contacts. Residual, kinetic energy and motion are left
/// at 0.
template <class Real>
RestReport certify(ShapeBed& bed, const Processor& processor, double dt,
                   ShapeStepState<Real>& state);

/// Settles `bed`: takes the solver, step, momentum, iterations and tolerances of `accuracy`.
/// `keep_going` is asked after every step; it is given no state to save.
SettleReport settle(const Accuracy& accuracy, const Processor& processor, ShapeBed& bed,
                    const KeepGoing& keep_going);

}  // namespace grainsweep
