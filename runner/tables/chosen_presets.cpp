#include "runner/tables/chosen_presets.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/dynamics/presets.hpp"
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

/// The parameters of a job but for its container, its fill and how it is settled.
std::string grains_of(const Job& job) {
  nlohmann::json parameters = nlohmann::json::parse(job.parameters.text());
  for (const char* path : {"box", "tube", "fill", "accuracy"}) parameters.erase(path);
  return parameters.dump();
}

/// What was chosen for the same grains in different containers.
struct ChosenForGrains {
  std::string label;             ///< of the first of them
  std::vector<bool> are_chosen;  ///< of presets()
};

/// A line about each kind of grains whose containers got different presets.
std::string split_text(const std::map<std::string, ChosenForGrains>& chosen) {
  std::string text;
  for (const auto& [grains, one] : chosen) {
    std::string names, finest;
    for (std::size_t k = 0; k < one.are_chosen.size(); ++k) {
      if (!one.are_chosen[k]) continue;
      finest = "\"" + std::string(presets()[k].name) + "\"";
      names += (names.empty() ? "" : " and ") + finest;
    }
    if (std::count(one.are_chosen.begin(), one.are_chosen.end(), true) < 2) continue;
    text += "The same grains, as in \"" + one.label + "\", are settled as " + names +
            " in different containers: no line joins these, and none is the other's value without "
            "walls; for that write \"preset\": " +
            finest + " in place of the accuracy that is asked for\n";
  }
  return text;
}

}  // namespace

std::string chosen_presets_text(const Sweep& sweep) {
  std::map<std::string, ChosenForGrains> chosen;
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
    ChosenForGrains& for_grains = chosen.try_emplace(grains_of(job)).first->second;
    if (for_grains.label.empty()) for_grains.label = job.label;
    for_grains.are_chosen.resize(std::size(presets()));
    for (std::size_t k = 0; k < for_grains.are_chosen.size(); ++k) {
      if (presets()[k].name == settles_as(job.spec.accuracy)) for_grains.are_chosen[k] = true;
    }
  }
  std::string text;
  for (const auto& [reason, sets] : reasons) {
    text += "Accuracy of " + counted(sets, "parameter set") + reason + "\n";
  }
  return text + split_text(chosen);
}

}  // namespace grainsweep
