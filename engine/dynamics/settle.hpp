// From loose grains in the air to a bed at rest, stage after stage.
//
// Spheres and polyhedra go through the same kinds of stages: a look at the bed, which is left as it
// is if it is already at rest; the fall, until the floor carries the bed; a creep and a slower one,
// in which grains slide into their places; the ease, until the bed is calm; and the quench, until
// every test of rest holds. A bed that fails these tests eases on and is quenched again. With the
// protocol `dynamic` grains fall as in plain contact dynamics, undamped and in steps a quarter as
// long, until they have lost their kinetic energy by impacts alone; the other stages follow.
// engine/dynamics/stages.cpp says what a step is like in each stage, and why.
//
// How loosely the fall is solved is part of how a bed was packed, because the errors of loose
// solves act like tapping: see engine/dynamics/sleep.hpp, and closer_where_narrow in
// engine/dynamics/stages.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/context.hpp"
#include "engine/results.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

struct SettleReport : BedForces {
  RestReport rest;
  std::string failure;  ///< the test of rest that failed; empty if settled
  bool precision_insufficient =
      false;  ///< no solve of this accuracy is exact enough for the bed: none was made
  bool cancelled = false;
  /// Whether the centres of two grains came nearer on the way than sunk_share of the distance at
  /// which they, or the balls within polyhedra, touch: they may have passed through one another.
  /// That does no harm to a random start; a bed that was given may lose its arrangement.
  bool sank = false;
  double spurious_path = 0.0;  ///< sum of StepReport::spurious_path over all steps, d
  std::int64_t steps = 0;
  std::int64_t iterations = 0;
  std::vector<double> force;  ///< sum of contact force magnitudes on each grain, m g
};

/// Settles `bed`, whose numbers must be finite; if they cease to be, it ends at once and the bed is
/// never called settled. When `keep_going` is asked: see KeepGoing.
/// `saved`: bytes that Progress::save gave for the same bed and accuracy, from which to go on;
/// bytes of another number or kind of grains or another precision are ignored.
template <class Kind>
SettleReport settle(const Accuracy& accuracy, const ExecutionContext& context, Bed<Kind>& bed,
                    const KeepGoing& keep_going, std::string_view saved = {});

}  // namespace grainsweep
