#include "runner/tables/chosen_presets.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/text.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/tables/job_facts.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// "0.003 in solid fraction, 0.1 in coordination", as far as they are given.
std::string both_text(double solid_fraction, double coordination) {
  std::string text;
  if (solid_fraction > 0.0) text = bound_text(solid_fraction) + " in solid fraction";
  if (coordination > 0.0) {
    text += (text.empty() ? "" : ", ") + bound_text(coordination) + " in coordination";
  }
  return text;
}

/// For a job whose preset was chosen, and which therefore has bounds.
std::string reason_text(const Job& job) {
  const JobFacts facts = facts_of(job);
  const auto bound = bias_bound(facts);
  if (!bound) return "";
  const ErrorWish& asked = job.asked_accuracy;
  return joined(" of ", name_of(*facts.kind), ": \"", settles_as(job.spec.accuracy),
                "\", the cheapest preset that moves means by no more than ",
                both_text(asked.solid_fraction, asked.coordination),
                "; its bounds: ", both_text(bound->solid_fraction, bound->coordination));
}

}  // namespace

std::string chosen_presets_text(const Sweep& sweep) {
  std::vector<std::pair<std::string, std::size_t>> reasons;  // with parameter sets
  const Job* before = nullptr;
  for (const Job& job : sweep.jobs) {
    const bool is_new = before == nullptr || before->parameters != job.parameters;
    before = &job;
    if (!is_new || !job.asked_accuracy.is_given()) continue;
    std::string reason = reason_text(job);
    auto known = std::find_if(reasons.begin(), reasons.end(),
                              [&](const auto& one) { return one.first == reason; });
    if (known == reasons.end()) known = reasons.insert(known, {std::move(reason), 0});
    ++known->second;
  }
  std::string text;
  for (const auto& [reason, sets] : reasons) {
    text += "Accuracy of " + counted(sets, "parameter set") + reason + "\n";
  }
  return text;
}

}  // namespace grainsweep
