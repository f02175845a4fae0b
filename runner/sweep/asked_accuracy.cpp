#include "runner/sweep/asked_accuracy.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/dynamics/presets.hpp"
#include "engine/text.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

/// A preset that was measured for a kind of beds.
struct Measured {
  const Preset* preset;
  ProtocolBias bound;
};
using MeasuredPresets = std::vector<Measured>;  // the cheaper ones first

MeasuredPresets measured_for(BedKind kind) {
  MeasuredPresets measured;
  for (const Preset& known : presets()) {
    if (const auto bound = bias_bound(known.name, kind)) measured.push_back({&known, *bound});
  }
  return measured;
}

/// One of the two bounds that may be requested; `assignment` is null where it is not.
struct Asked {
  const Assignment* assignment;
  double ProtocolBias::*bound;
};

double value_of(const Asked& asked) { return std::get<double>(asked.assignment->value); }

/// Keeps those of the presets that keep the bound. Where none does, says so, and keeps them all. If
/// two bounds are requested, the message names presets that keep the other one as well.
void keep_reaching(const Asked& asked, BedKind kind, const MeasuredPresets& all,
                   MeasuredPresets& measured, std::vector<AccuracyProblem>& problems) {
  if (asked.assignment == nullptr) return;
  const Parameter& parameter = parameters()[asked.assignment->parameter];
  if (std::string error = range_error(parameter, asked.assignment->value); !error.empty()) {
    problems.push_back({asked.assignment, std::move(error)});
    return;
  }
  MeasuredPresets reaching;
  for (const Measured& one : measured) {
    if (one.bound.*asked.bound <= value_of(asked)) reaching.push_back(one);
  }
  if (!reaching.empty()) {
    measured = std::move(reaching);
    return;
  }
  const Measured& best = *std::min_element(measured.begin(), measured.end(), [&](auto& a, auto& b) {
    return a.bound.*asked.bound < b.bound.*asked.bound;
  });
  problems.push_back(
      {asked.assignment,
       joined("must be at least ", bound_text(best.bound.*asked.bound),
              ", the smallest bound that was measured of ", name_of(kind),
              measured.size() < all.size() ? " by presets that keep the other one" : "", ", by \"",
              best.preset->name, "\"; is ", bound_text(value_of(asked)))});
}

bool is_part_of_accuracy(const Assignment* assignment) {
  if (assignment == nullptr) return false;
  const Parameter& parameter = parameters()[assignment->parameter];
  return parameter.path.starts_with("accuracy.") && choice_of(parameter) != Choice::accuracy;
}

/// Writes the parts beside the request over those of the preset.
void take_parts(const InEffect& in_effect, ResolvedSpec& resolved,
                std::vector<AccuracyProblem>& problems) {
  for (const Assignment* assignment : in_effect) {
    if (!is_part_of_accuracy(assignment)) continue;
    const Parameter& parameter = parameters()[assignment->parameter];
    parameter.set(resolved, assignment->value);
    if (leaves_the_bound(parameter)) continue;
    problems.push_back(
        {assignment,
         "changes how beds settle, and what that does to means was not measured; take it out, or "
         "write \"preset\" in place of the accuracy that is asked for"});
  }
}

}  // namespace

bool leaves_the_bound(const Parameter& parameter) {
  return parameter.path == "accuracy.precision" || parameter.path == "accuracy.max_steps";
}

std::vector<AccuracyProblem> take_asked_accuracy(const InEffect& in_effect,
                                                 ResolvedSpec& resolved) {
  const Asked solid_fraction{in_effect[*find_parameter("accuracy.solid_fraction")],
                             &ProtocolBias::solid_fraction};
  const Asked coordination{in_effect[*find_parameter("accuracy.coordination")],
                           &ProtocolBias::coordination};
  const Asked& first = solid_fraction.assignment != nullptr ? solid_fraction : coordination;
  if (first.assignment == nullptr) return {};
  std::vector<AccuracyProblem> problems;
  const std::vector<double>& gaps = resolved.spec.measure.gap_tolerances;
  if (coordination.assignment != nullptr && !gaps.empty() && gaps.front() != measured_gap) {
    problems.push_back({coordination.assignment,
                        joined("cannot be promised of neighbours by a gap below ", gaps.front(),
                               " d, as bounds were measured at ", measured_gap,
                               " d; put that first in measure.gap_tolerances")});
  }
  const auto kind = bed_kind(resolved.spec);
  if (kind) {
    const MeasuredPresets all = measured_for(*kind);
    MeasuredPresets measured = all;
    keep_reaching(solid_fraction, *kind, all, measured, problems);
    keep_reaching(coordination, *kind, all, measured, problems);
    resolved.spec.accuracy = measured.front().preset->accuracy;
  } else {
    problems.push_back({first.assignment,
                        joined(R"(write "preset": ")", default_preset,
                               R"(" in its place: no bound was measured for such beds of shape ")",
                               name_of(resolved.spec.shape),
                               R"("; see "Accuracy that is asked for" in configs/README.md)")});
  }
  take_parts(in_effect, resolved, problems);
  return problems;
}

}  // namespace grainsweep
