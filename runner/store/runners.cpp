#include "runner/store/runners.hpp"

#include <algorithm>
#include <fcntl.h>

#include <sys/stat.h>

#include "runner/machine.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/lock.hpp"
#include "runner/store/shard.hpp"

namespace grainsweep {
namespace {

/// Time since a file was changed, s; 0 if it is gone.
double seconds_since_change(const std::string& path) {
  struct stat facts {};
  if (stat(path.c_str(), &facts) != 0) return 0.0;
  const double changed =
      static_cast<double>(facts.st_mtim.tv_sec) + 1e-9 * static_cast<double>(facts.st_mtim.tv_nsec);
  return calendar_seconds() - changed;
}

}  // namespace

std::vector<Runner> runners_in(const std::string& folder,
                               const std::map<std::string, RunRecord>& last_runs) {
  std::vector<Runner> runners;
  for (const std::string& shard : shards_in(folder)) {
    const std::string path = journal_path(folder, shard);
    const auto last = last_runs.find(shard);
    const bool has_run = last != last_runs.end(), has_lock = is_locked(path);
    if (!has_lock && (!has_run || !last->second.ended.empty())) continue;
    Runner runner{shard, has_run ? last->second : RunRecord{}, false, seconds_since_change(path)};
    const bool has_died = has_ended(runner.run.process) || runner.silent >= lost_after_seconds;
    runner.is_lost = !has_lock && has_died;
    runners.push_back(std::move(runner));
  }
  return runners;
}

std::vector<Runner> runners_at_work(const std::string& folder,
                                    const std::map<std::string, RunRecord>& last_runs) {
  std::vector<Runner> runners = runners_in(folder, last_runs);
  std::erase_if(runners, [](const Runner& runner) { return runner.is_lost; });
  return runners;
}

std::vector<Runner> runners_at_work(const std::string& folder) {
  std::map<std::string, RunRecord> last_runs;
  for (const std::string& shard : shards_in(folder)) {
    if (auto run = last_run_in(journal_path(folder, shard))) last_runs[shard] = *std::move(run);
  }
  return runners_at_work(folder, last_runs);
}

bool is_worked_on(const std::string& folder, const std::map<std::string, RunRecord>& last_runs) {
  return !runners_at_work(folder, last_runs).empty();
}

std::string owner_text(const std::optional<RunRecord>& run) {
  if (!run || run->process.empty()) return "another process";
  return "host " + run->host + ", process " + number_of_process(run->process);
}

void touch_journal(const std::string& path) { utimensat(AT_FDCWD, path.c_str(), nullptr, 0); }

}  // namespace grainsweep
