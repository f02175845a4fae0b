// Any text as a sweep file: it is read, or refused with a place and a message; never a crash.
//
// Built by fuzz.sh with libFuzzer, the address and the undefined-behaviour sanitizer.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "runner/sweep/blocks.hpp"
#include "runner/sweep/expand.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/problem.hpp"

namespace grainsweep {
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

void expect_sound(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    if (finding.place.empty() || finding.message.empty()) std::abort();
    if (to_string(finding).find('\n') != std::string::npos) std::abort();
  }
}

void read_as_sweep(const std::string& text) {
  const JsonReading json = parse_strictly(text, "fuzz.json");
  expect_sound(json.errors);
  if (!json.errors.empty()) return;
  Problems problems;
  const Blocks blocks = read_blocks(json.value, problems);
  if (job_count_of(blocks) <= most_expanded) {
    const auto jobs = expand(blocks, "", problems);
    for (const Job& job : jobs) {
      if (problems.empty() && !check(job.spec).empty()) std::abort();
    }
  }
  const auto findings = findings_of(problems, text, "fuzz.json");
  expect_sound(findings);
  if (findings.empty() != problems.empty()) std::abort();
}

}  // namespace
}  // namespace grainsweep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  grainsweep::read_as_sweep(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
