// The stages of settling: what a step is like in each, and how long they usually take.
// What each is for is told in engine/dynamics/settle.hpp.
#pragma once

#include <cstdint>

#include "engine/dynamics/step.hpp"
#include "engine/scene/spec.hpp"

namespace grainsweep {

/// The creep has two parts: its loose and its good solves. `rest` is the end.
enum class Stage { look, fall, dynamic_fall, loose_creep, creep, halt, quench, rest };

/// A step of a stage. Requires a stage before `rest`.
StepSettings settings_of(const Accuracy& accuracy, Stage stage);

/// Steps that a stage takes; for the stages that end on a condition, the least.
std::int64_t steps_of(const Accuracy& accuracy, Stage stage);

/// Share of the work done after some steps of a stage: an estimate for progress bars.
double share_done(const Accuracy& accuracy, Stage stage, std::int64_t steps_in_stage);

}  // namespace grainsweep
