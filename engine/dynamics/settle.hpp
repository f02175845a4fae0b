// From loose grains in the air to a bed at rest, in four stages.
//
//   fall    full steps with momentum, until the floor carries the bed; overlaps repaired by 10 % a
//           step, so that loose solves do not throw grains about
//   creep   double steps with momentum: grains slide into their places. The errors of loose solves
//           act like tapping, so this is an annealing: the first two thirds of the steps are solved
//           with half the iterations. Good solves throughout take five times as many steps to the
//           same number of contacts. Overlaps are repaired by 30 %: what repairs move is carried on
//           as if it were speed, and repaired whole it throws beds of two sizes apart.
//   halt    full steps without momentum: what still moves is slowed down
//   quench  half steps without momentum: contacts close, until every test of rest holds
//
// With the protocol `dynamic` grains fall as in plain contact dynamics, undamped and in steps of a
// quarter, until they have lost their kinetic energy by impacts alone; then comes the quench.
//
// Grains that turn come to rest in four stages after the fall:
//
//   creep   full steps, solved a little better than the fall: as with spheres, more steps of loose
//           solves reach more contacts than fewer of good ones
//   slow    half steps; the step must not be shortened to a quarter at once, which leaves motions
//           that take many short steps to die
//   halt    quarter steps without momentum, solved half as well as the quench: what still moves is
//           slowed down
//   quench  quarter steps without momentum: contacts close, until every test of rest holds
//
// How loosely their fall is solved is part of how a bed was packed: fewer iterations act like
// tapping and pack pinacoids denser, by .008 in solid fraction from 100 iterations to 40.
//
// A bed that rests as it is given stays as it is: the first stage is a look at it, a few steps of
// the quench.
//
// How loosely the fall is solved is part of how a bed was packed: see engine/dynamics/presets.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/step.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

struct SettleReport {
  RestReport rest;
  std::string why_not;  ///< the test of rest that failed; empty if settled
  bool unfit = false;   ///< no solve of this accuracy is exact enough for the bed: none was made
  bool cancelled = false;
  /// Whether the centres of two grains came nearer on the way than sunk_share of the distance at
  /// which they touch: they may have passed through one another. A random start has nothing to lose
  /// by it, a bed that was given its arrangement. Grains that turn are not looked at.
  bool sank = false;
  std::int64_t steps = 0;
  std::int64_t iterations = 0;
  std::optional<ForceBalance> balance;  ///< if the accuracy asks for it
  std::vector<double> force;            ///< sum of contact force magnitudes on each grain, m g
  std::vector<PairForce> pair_forces;   ///< of the last step
};

/// Settles `bed`, whose numbers must be finite; a state that becomes otherwise ends it at once and
/// is never called settled. `keep_going` is asked after every step. `saved`: bytes that
/// Progress::save gave for the same bed and accuracy, from which to go on; others are not taken.
SettleReport settle(const Accuracy& accuracy, const ExecutionContext& context, SphereBed& bed,
                    const KeepGoing& keep_going, std::string_view saved = {});

/// The same for grains that turn, which know neither the protocol `dynamic` nor the direct solve of
/// force balance.
SettleReport settle(const Accuracy& accuracy, const ExecutionContext& context, PolyhedronBed& bed,
                    const KeepGoing& keep_going, std::string_view saved = {});

}  // namespace grainsweep
