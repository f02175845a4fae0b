// A runner whose own shard is made helps the others.
//
// Estimates divide a sweep well on average, but a packing may take twice as long as its estimate,
// and a shard of few packings with it. So a runner that has finished finds the shard that has most
// left to do and takes over half of what that has not begun yet, from its end, and so on until
// nothing is left. What it makes goes into its own files.
#pragma once

#include <string>
#include <vector>

#include "engine/cost.hpp"
#include "runner/store/claims.hpp"
#include "runner/store/shard.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// What is left to do in a shard that a runner works on: jobs that are neither made nor claimed, by
/// their places in the sweep, in the order in which the runner takes them.
struct LeftToDo {
  int under_way = 1;  ///< so many of the first ones may have been begun
  std::vector<std::size_t> jobs;
};

/// The jobs to take over next, in the same order; none if nobody needs help.
std::vector<std::size_t> jobs_to_take_over(const std::vector<LeftToDo>& shards,
                                           const std::vector<Cost>& costs);

/// The claims of this process. Claims of runners that are not at work are void; what such runners
/// have made is in the journals, provided these are read later.
Claims claims_in(const std::string& folder);

/// Jobs that are now this runner's, and the claims by which others see that.
struct TakenOver {
  Claims claims;
  std::vector<const Job*> jobs;
};

/// The other shards of a sweep, as the runner of one sees them.
class Helping {
 public:
  /// Refers to the sweep. `own`: the shard of this runner.
  Helping(const Sweep& sweep, const Shard& own, std::string folder);
  Helping(Sweep&&, const Shard&, std::string) = delete;

  /// Claims the next jobs to make: those that ended runners had claimed and not made, or those
  /// taken over from a runner at work; no job if nobody needs help. From now on all runners claim
  /// what they begin.
  TakenOver next() const;

 private:
  std::vector<std::size_t> wanted(const Claims& claims) const;
  std::vector<const Job*> jobs_of(const std::vector<std::string>& ids) const;

  const Sweep& sweep_;
  Shard own_;
  std::string folder_;
  std::vector<Cost> costs_;
  std::vector<std::vector<std::size_t>> jobs_of_shard_;  ///< longest first; shards count from 0
};

}  // namespace grainsweep
