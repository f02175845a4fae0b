#include "runner/jobs/helping.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "runner/jobs/schedule.hpp"
#include "runner/jobs/sweep_parts.hpp"
#include "runner/machine.hpp"
#include "runner/store/journal.hpp"
#include "runner/store/runners.hpp"
#include "runner/sweep/costs.hpp"

namespace grainsweep {
namespace {

double seconds_of(const std::vector<std::size_t>& jobs, const std::vector<Cost>& costs) {
  double seconds = 0.0;
  for (const std::size_t job : jobs) seconds += costs[job].cpu_seconds;
  return seconds;
}

/// The jobs of the shard that its runner has not begun.
std::vector<std::size_t> free_of(const LeftToDo& shard) {
  const auto begun =
      std::min(static_cast<std::size_t>(std::max(0, shard.under_way)), shard.jobs.size());
  return {shard.jobs.begin() + static_cast<std::ptrdiff_t>(begun), shard.jobs.end()};
}

}  // namespace

std::vector<std::size_t> jobs_to_take_over(const std::vector<LeftToDo>& shards,
                                           const std::vector<Cost>& costs) {
  std::vector<std::size_t> most;
  double seconds = 0.0;
  for (const LeftToDo& shard : shards) {
    std::vector<std::size_t> jobs = free_of(shard);
    const double left = seconds_of(jobs, costs);
    if (jobs.empty() || (!most.empty() && left <= seconds)) continue;
    most = std::move(jobs);
    seconds = left;
  }
  most.erase(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(most.size() / 2));
  return most;
}

Claims claims_in(const std::string& folder) {
  if (!has_claims(folder)) return {folder, process_name()};  // no journal has to be read for them
  std::set<std::string> processes;
  for (const Runner& runner : runners_at_work(folder)) processes.insert(runner.run.process);
  return {folder, process_name(), processes};
}

Helping::Helping(const Sweep& sweep, const Shard& own, std::string folder)
    : sweep_(sweep),
      own_(own),
      folder_(std::move(folder)),
      costs_(costs_of(sweep.jobs)),
      jobs_of_shard_(static_cast<std::size_t>(own.count)) {
  const std::vector<int> shard_of = shards_of(sweep, own.count);
  for (const std::size_t job : longest_first(costs_)) {
    jobs_of_shard_[static_cast<std::size_t>(shard_of[job] - 1)].push_back(job);
  }
}

TakenOver Helping::next() const {
  open_claims(folder_);  // before journals are read: what they do not show as begun is claimed
  for (;;) {
    Claims claims = claims_in(folder_);
    std::vector<std::string> chosen;
    for (const std::size_t job : wanted(claims)) chosen.push_back(sweep_.jobs[job].id);
    const std::vector<std::string> taken = claims.take(chosen);
    if (chosen.empty() || !taken.empty()) return {std::move(claims), jobs_of(taken)};
  }
}

std::vector<std::size_t> Helping::wanted(const Claims& claims) const {
  const JournalReading stored = read_journals(folder_, Detail::summary);
  const auto is_made = [&](std::size_t job) {
    return stored.outcomes.contains(sweep_.jobs[job].id);
  };
  std::vector<std::size_t> abandoned;
  for (std::size_t job = 0; job < sweep_.jobs.size(); ++job) {
    if (claims.abandoned().contains(sweep_.jobs[job].id) && !is_made(job)) abandoned.push_back(job);
  }
  if (!abandoned.empty()) return abandoned;
  std::vector<LeftToDo> shards;
  for (const Runner& runner : runners_at_work(folder_, stored.last_runs)) {
    const Shard shard = *shard_from_name(runner.shard);
    if (shard == own_ || shard.count != own_.count) continue;
    LeftToDo& left = shards.emplace_back();
    left.under_way = runner.run.threads;
    for (const std::size_t job : jobs_of_shard_[static_cast<std::size_t>(shard.number - 1)]) {
      if (is_made(job)) continue;
      const std::string owner = claims.owner_of(sweep_.jobs[job].id);
      if (owner.empty()) left.jobs.push_back(job);
      if (owner == runner.run.process) --left.under_way;
    }
  }
  return jobs_to_take_over(shards, costs_);
}

std::vector<const Job*> Helping::jobs_of(const std::vector<std::string>& ids) const {
  const std::set<std::string> wanted(ids.begin(), ids.end());
  std::vector<const Job*> jobs;
  for (const Job& job : sweep_.jobs) {
    if (wanted.contains(job.id)) jobs.push_back(&job);
  }
  return jobs;
}

}  // namespace grainsweep
