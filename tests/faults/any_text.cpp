#include "tests/faults/any_text.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "runner/sweep/blocks.hpp"
#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/problem.hpp"

namespace grainsweep::testing {
namespace {

/// A sweep may ask for a million jobs in a line; that many take seconds by right.
constexpr std::uint64_t most_expanded = 2'000;

std::uint64_t job_count_of(const Blocks& blocks) {
  std::uint64_t jobs = 0;
  for (const Block& block : blocks.blocks) {
    const std::uint64_t points = point_count(block);
    if (points > most_expanded) return points;
    jobs += points * static_cast<std::uint64_t>(block.replicates);
  }
  return jobs;
}

bool are_sound(const std::vector<Finding>& findings) {
  return std::all_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return !finding.place.empty() && !finding.message.empty() &&
           to_string(finding).find('\n') == std::string::npos;
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
  Problems problems;
  const Blocks blocks = read_blocks(json.value, problems);
  std::vector<Job> jobs;
  if (job_count_of(blocks) <= most_expanded) jobs = expand(blocks, "", problems);
  const std::vector<Finding> findings = findings_of(problems, text, "any.json");
  const bool is_sweep = problems.empty();
  const bool is_consistent = findings.empty() == is_sweep && (!is_sweep || can_be_made(jobs));
  return {true, is_sweep, is_consistent && are_sound(findings)};
}

}  // namespace grainsweep::testing
