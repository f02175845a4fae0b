// The lines of all journals in a folder, and which of two that speak of one job counts.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runner/store/files.hpp"

namespace grainsweep {

/// Reads every journal line by `read_line` (line -> optional facts with the members job and threw).
/// Of two facts on a job the later one counts, but a result is never replaced by an exception.
/// Returns the damage: "journal-a-12.jsonl:3: torn or damaged line ...". Throws FileError.
template <class Facts, class ReadLine>
std::vector<std::string> collect_lines(const std::string& folder, ReadLine read_line,
                                       std::map<std::string, Facts>& by_job) {
  std::vector<std::string> damage;
  const auto keep = [&](Facts&& facts) {
    const auto known = by_job.find(facts.job);
    if (known == by_job.end()) {
      std::string job = facts.job;
      by_job.emplace(std::move(job), std::move(facts));
    } else if (!facts.threw || known->second.threw) {
      known->second = std::move(facts);
    }
  };
  for (const std::string& name : files_in(folder, "journal-", ".jsonl")) {
    std::size_t number = 0;
    for_each_line(folder + "/" + name, [&](std::string_view line) {
      ++number;
      if (auto facts = read_line(line)) return keep(std::move(*facts));
      damage.push_back(name + ":" + std::to_string(number) +
                       ": torn or damaged line, left out; its packing is made again");
    });
  }
  return damage;
}

}  // namespace grainsweep
