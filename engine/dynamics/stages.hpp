// The stages of settling: what each is for, what a step is like in it, what ends it, and how long
// it usually takes. The table itself is in stages.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "engine/dynamics/step.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// What ends a stage once it has taken its steps.
enum class StageEnd {
  steps,   ///< nothing else
  look,    ///< every test of rest holds or is far from it, or the floor does not carry the bed
  fallen,  ///< the floor carries the bed, which has lost its speed
  halted,  ///< the same, and the bed's kinetic energy is below its tolerance
  calm,    ///< nothing moves the bed but less than it may be out of balance, or its most steps
  rest,    ///< every test of rest holds; a bed that fails goes back a stage
};

/// What a step takes over from the motion of the last one.
enum class Inertia { none, damped, full };

/// What a stage changes in a step. Motions and overlaps are proportional to the square of a step,
/// so that shorter steps need to look less far.
struct StageRule {
  const char* name = "";
  StageEnd end = StageEnd::steps;
  double step = 1.0;      ///< in Accuracy::step
  bool by_depth = false;  ///< inertia grows with depth, and high beds take shorter steps
                          ///< (engine/dynamics/inertia.hpp)
  Inertia inertia = Inertia::none;
  // A step that strays by less than one of these is solved:
  double path = 0.0;           ///< so many times Accuracy::path_tolerance
  double path_of_creep = 0.0;  ///< so many times that in all steps of its share of the creep
  double path_of_gap = 0.0;    ///< so many times Accuracy::imbalance_gap
  bool sleeps = false;         ///< the deep bed sleeps
  double longest_free = 0.15;  ///< longest free motion, d
  bool carries = false;        ///< impulses begin such that they carry a tall bed
  double correction = 0.0;     ///< share of an overlap that a step repairs
  double near = 0.0;           ///< pairs with a smaller gap are rows, d
  double margin = 0.0;         ///< as in StepSettings, d
  int steps_on_contacts = 1;   ///< so many steps are taken on contacts found once
  // Iterations a step (Accuracy says when there are more): the sum of
  double fall_iterations = 0.0;  ///< so many times Accuracy::fall_iterations and
  double rest_iterations = 0.0;  ///< so many times Accuracy::rest_iterations
  int closer = 1;  ///< times as many for a bed that is carried, if the stage looks at one
  // Number of steps (if the stage ends on a condition, the least): the sum of
  std::int64_t steps = 0;  ///< these, and
  double creep = 0.0;      ///< this share of Accuracy::creep_steps
  std::int64_t most_steps =
      std::numeric_limits<std::int64_t>::max();  ///< it ends after these; the last gives up
  double energy = 0.0;  ///< m g d per grain; a bed with less of it has lost its speed
  // For progress bars:
  std::int64_t usual_steps = 0;  ///< of stages that end on a condition
  double done_before = 0.0;      ///< share of all work that is usually done before it
  double done_after = 0.0;       ///< and after it
};

/// The stages in their order, the first a look at the bed as it is given. The last one and that
/// before it take turns until the bed rests.
using Stages = std::span<const StageRule>;
template <class Kind>
Stages stages_of(Protocol protocol);

/// How well a bed is settled between walls that are near, or in a short periodic box: there loose
/// solves tap grains into order, so that contacts may stray less far.
Accuracy closer_where_narrow(const Accuracy& accuracy, const Box& box);

/// Mean motion in a step (StepReport::mean_motion), d, below which a bed is calm: what a net force
/// of Accuracy::imbalance_tolerance own weights keeps a grain near the surface moving by.
double calm_motion(const Accuracy& accuracy, const StageRule& rule);

/// The settings of a step of a stage, for a bed of that height, d, and of so many mean diameters of
/// its grains.
StepSettings settings_of(const Accuracy& accuracy, const StageRule& rule, double height = 0.0,
                         double layers = 0.0);

/// Steps that a stage takes; for the stages that end on a condition, the least.
std::int64_t steps_of(const Accuracy& accuracy, const StageRule& rule);

/// Share of the work done after some steps of a stage: an estimate for progress bars.
double share_done(const Accuracy& accuracy, const StageRule& rule, std::int64_t steps_in_stage);

}  // namespace grainsweep
