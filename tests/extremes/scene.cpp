#include "tests/extremes/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace grainsweep::extremes {

namespace {

/// Error of an answer in units of its tolerance.
double in_tolerances(const Answer& answer) {
  constexpr double beyond_all = std::numeric_limits<double>::infinity();
  if (answer.tolerance > 0.0)
    return std::isnan(answer.error) ? beyond_all : answer.error / answer.tolerance;
  return answer.error == 0.0 ? 0.0 : beyond_all;
}

}  // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::refused:
      return "refused";
    case Outcome::not_settled:
      return "not settled";
    case Outcome::silently_wrong:
      break;
  }
  return "SILENTLY WRONG";
}

Outcome outcome_of(const Finding& finding) {
  if (!finding.finite) return Outcome::silently_wrong;
  if (!finding.refusal.empty()) return Outcome::refused;
  if (!finding.unrest.empty()) return Outcome::not_settled;
  const bool right = !finding.answers.empty() &&
                     std::all_of(finding.answers.begin(), finding.answers.end(),
                                 [](const Answer& answer) { return answer.is_right(); });
  return right ? Outcome::right : Outcome::silently_wrong;
}

bool keeps_promise(const Scene& scene, Outcome outcome) {
  return outcome == scene.expected ||
         (scene.expected == Outcome::not_settled && outcome != Outcome::silently_wrong);
}

const Answer* worst_answer(const Finding& finding) {
  const auto worst = std::max_element(
      finding.answers.begin(), finding.answers.end(),
      [](const Answer& a, const Answer& b) { return in_tolerances(a) < in_tolerances(b); });
  return worst == finding.answers.end() ? nullptr : &*worst;
}

}  // namespace grainsweep::extremes
