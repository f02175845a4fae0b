// Who works in an output folder, and who was lost on the way.
//
// A runner that began a run and noted no end of it is at work or lost. Its lock tells, but not
// everywhere to other machines: from time to time a runner touches its journal, too.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runner/store/run_record.hpp"

namespace grainsweep {

/// Between two touches, and without one for so long a runner of another machine is lost, s. File
/// systems of clusters tell others of a touch up to a minute later.
constexpr double heartbeat_seconds = 20.0, lost_after_seconds = 180.0;

struct Runner {
  std::string shard;  ///< name of its files
  RunRecord run;      ///< without host and process where its journal is damaged
  bool is_lost = false;
  double silent = 0.0;  ///< since its journal was touched or written, s
};

/// Those that have not ended, by shard. `last_runs`: of each shard, as JournalReading has them.
std::vector<Runner> runners_in(const std::string& folder,
                               const std::map<std::string, RunRecord>& last_runs);

/// Whether one of them is at work.
bool is_worked_on(const std::string& folder, const std::map<std::string, RunRecord>& last_runs);

/// "host n7, process 4711"; "another process" if there is no run.
std::string owner_text(const std::optional<RunRecord>& run);

/// Says that a runner is alive; nothing happens if its journal is gone.
void touch_journal(const std::string& path);

}  // namespace grainsweep
