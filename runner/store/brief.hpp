// What `status` needs of stored packings: a few facts of each, read twenty times faster than the
// whole.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "runner/store/outcome.hpp"

namespace grainsweep {

/// Members as of Outcome.
struct Brief {
  std::string job;
  std::string version;
  PackingStatus status = PackingStatus::failed;
  bool threw = false;
  double cpu_seconds = 0.0;  ///< s
};

/// The facts in a journal line; nothing where read_journal_line gives nothing. Lines that `version`
/// wrote are searched for the members, which nothing but this version's form of a line allows;
/// others are read whole.
std::optional<Brief> read_brief(std::string_view line, std::string_view version);

struct BriefReading {
  std::unordered_map<std::string, Brief> briefs;  ///< by job, in no order that means anything
  std::vector<std::string> damage;                ///< as of JournalReading
};

/// All journals in `folder`, with the rules of read_journals. Takes memory for the facts alone.
/// Throws FileError.
BriefReading read_briefs(const std::string& folder, std::string_view version);

}  // namespace grainsweep
