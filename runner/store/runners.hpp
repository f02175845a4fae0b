// Who works in an output folder, and who was lost on the way.
//
// A runner that began a run and noted no end of it is at work or lost. Its lock shows which, but
// not everywhere to other machines, so a runner also touches its journal from time to time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runner/store/run_record.hpp"

namespace grainsweep {

/// Time between two touches, and the time without one after which a runner counts as lost that
/// cannot be seen to have ended (on another machine), s. On file systems of clusters others may see
/// a touch up to a minute later.
constexpr double heartbeat_seconds = 20.0, lost_after_seconds = 180.0;

struct Runner {
  std::string shard;  ///< name of its files
  RunRecord run;      ///< without host and process where its journal is damaged
  bool is_lost = false;
  double silent = 0.0;  ///< since its journal was touched or written, s
};

/// The runners that have not ended, by shard. `last_runs`: of each shard, as in JournalReading.
std::vector<Runner> runners_in(const std::string& folder,
                               const std::map<std::string, RunRecord>& last_runs);

/// Those of them that are at work, by what the journals say of their last runs.
std::vector<Runner> runners_at_work(const std::string& folder);
std::vector<Runner> runners_at_work(const std::string& folder,
                                    const std::map<std::string, RunRecord>& last_runs);

/// Whether one of them is at work.
bool is_worked_on(const std::string& folder, const std::map<std::string, RunRecord>& last_runs);

/// "host n7, process 4711"; "another process" if there is no run.
std::string owner_text(const std::optional<RunRecord>& run);

/// Says that a runner is alive; nothing happens if its journal is gone.
void touch_journal(const std::string& path);

}  // namespace grainsweep
