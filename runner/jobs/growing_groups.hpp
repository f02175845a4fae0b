// Groups that grow: packings are added until the error of a group's means is as small as wished, or
// that of a fit to the groups of a family (growing_fits.hpp).
//
// A group of which fewer than one in six packings settle, or none of the first six, grows no more:
// packings that do not settle take longest, and say nothing of its means.
//
// How many replicates a group has follows from the results of the first so many alone, its own or
// those of its family: it is the same for any number of threads and shards, and after a kill.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/cost.hpp"
#include "engine/dynamics/presets.hpp"
#include "runner/jobs/growing_families.hpp"
#include "runner/store/journal.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// How many replicates a group has to have, by what came of those made, in their order; nullptr
/// stands for one that is not made yet. `bound` is the bias of settling that its wish includes.
int replicates_called_for(const std::vector<const Outcome*>& made, const ErrorWish& wish,
                          const std::optional<ProtocolBias>& bound);

/// Which of the wishes were met, for the end of a run; empty if there are none.
std::string wishes_text(const Sweep& whole, const Outcomes& outcomes);

/// A sweep as far as the packings that are made call for its jobs. Refers to the whole sweep, which
/// has the most replicates of every group, and is that if none may grow.
class GrowingSweep {
 public:
  GrowingSweep(const Sweep& whole, const Outcomes& made);
  GrowingSweep(Sweep&& whole, const Outcomes& made) = delete;

  const Sweep& now() const { return grows_ ? called_ : whole_; }

  /// Looks at all that is made by now; whether anything is called for that was not before.
  bool grow(const Outcomes& made);

  /// Which errors are as asked for, by all that is made: `wishes_text` of the whole sweep.
  std::string wishes(const Outcomes& made) const { return wishes_text(whole_, made); }

 private:
  const Sweep& whole_;
  bool grows_;
  Sweep called_;  ///< empty if it does not grow
};

/// Each wish that no number of packings can meet, where it is written: the way of settling may do
/// more to the means, or a fit has fewer than three widths, or groups whose own wishes it would
/// have to follow.
Diagnostics unreachable_wishes(const Sweep& whole);

/// What a sweep takes at most whose groups grow, by the costs of all its jobs.
std::string growth_text(const std::vector<Cost>& most);

}  // namespace grainsweep
