// A requested accuracy: the largest bias that settling may give the means, in place of the name of
// a preset. The cheapest preset whose measured bound is no larger is taken.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/assignments.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// Whether this part of the accuracy may be written beside the request: no bed that settles depends
/// on the largest number of steps, and no mean depends on the precision by more than its error.
bool leaves_the_bound(const Parameter& parameter);

/// Why a requested accuracy cannot be had: the value that has to change, and what is wrong.
struct AccuracyProblem {
  const Assignment* assignment = nullptr;
  std::string message;
};

/// Where an accuracy is requested, gives `resolved`, which is complete apart from it, the accuracy
/// of the preset that is taken, with the parts beside it that may be written. Otherwise the
/// accuracy stays as it is. Problems: bounds that no preset keeps, beds for which none was
/// measured, and parts that change how a bed settles.
std::vector<AccuracyProblem> take_asked_accuracy(const InEffect& in_effect, ResolvedSpec& resolved);

}  // namespace grainsweep
