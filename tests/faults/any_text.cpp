#include "tests/faults/any_text.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/sweep_definition.hpp"

namespace grainsweep::testing {
namespace {

/// A sweep may ask for a million jobs in a line; that many take seconds by right.
constexpr std::uint64_t most_expanded = 2'000;

std::uint64_t job_count_of(const SweepDefinition& definition) {
  std::uint64_t jobs = 0;
  for (const Block& block : definition.blocks) {
    const std::uint64_t points = point_count(block);
    if (points > most_expanded) return points;
    jobs += points * static_cast<std::uint64_t>(block.replicates.most);
  }
  return jobs;
}

bool are_sound(const Diagnostics& diagnostics) {
  return std::all_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& diagnostic) {
    return !diagnostic.place.empty() && !diagnostic.message.empty() &&
           to_string(diagnostic).find('\n') == std::string::npos;
  });
}

bool can_be_made(const std::vector<Job>& jobs) {
  return std::all_of(jobs.begin(), jobs.end(),
                     [](const Job& job) { return check(job.spec).empty(); });
}

}  // namespace

Reading read_any_text(const std::string& text) {
  const JsonReading json = parse_strictly(text, "any.json");
  if (!json.errors.empty()) return {false, false, are_sound(json.errors)};
  Diagnostics diagnostics;
  const SweepDefinition definition = read_definition(json.value, diagnostics);
  std::vector<Job> jobs;
  if (job_count_of(definition) <= most_expanded) jobs = expand(definition, "", diagnostics);
  const bool is_sweep = diagnostics.empty();
  locate(json, text, "any.json", diagnostics);
  const bool is_consistent = diagnostics.empty() == is_sweep && (!is_sweep || can_be_made(jobs));
  return {true, is_sweep, is_consistent && are_sound(diagnostics)};
}

}  // namespace grainsweep::testing
