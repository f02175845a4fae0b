// Accuracy that is asked for: the largest bias that settling may give the means, in place of the
// name of a preset. The cheapest preset whose measured bound is no larger is taken.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/assignments.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// Whether a part of the accuracy may be written beside what is asked for: no bed that settles
/// depends on the most steps, and on the precision no mean by more than its error.
bool leaves_the_bound(const Parameter& parameter);

/// What keeps an accuracy from being had: the value that has to change, and why.
struct AccuracyProblem {
  const Assignment* assignment = nullptr;
  std::string message;
};

/// Where an accuracy is asked for, gives `resolved`, which is complete but for it, that of the
/// preset which is taken, with the parts beside it that may be written. Otherwise the accuracy
/// stays as it is. Problems: bounds that no preset keeps, beds of which none was measured, and
/// parts that change how a bed settles.
std::vector<AccuracyProblem> take_asked_accuracy(const InEffect& in_effect, ResolvedSpec& resolved);

}  // namespace grainsweep
