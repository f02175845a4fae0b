// The lines of all journals in a folder, and which of two that speak of one job counts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runner/store/files.hpp"

namespace grainsweep {

/// Reads every journal line by `read_line` (line -> optional facts with the members job and threw)
/// into a map from jobs to facts. Of two facts on a job the later one counts, but a result is never
/// replaced by an exception. Returns the damage: "journal-a-12.jsonl:3: torn or damaged line ...".
/// Throws FileError.
template <class ReadLine, class ByJob>
std::vector<std::string> collect_lines(const std::string& folder, ReadLine read_line,
                                       ByJob& by_job) {
  std::vector<std::string> damage;
  const auto keep = [&](typename ByJob::mapped_type&& facts) {
    const auto [known, is_new] = by_job.try_emplace(facts.job);
    if (is_new || !facts.threw || known->second.threw) known->second = std::move(facts);
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
