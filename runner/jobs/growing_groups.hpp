// Groups that grow: packings are added until the error of a group's means is as small as requested,
// or that of a fit to the groups of a family (growing_fits.hpp).
//
// A group grows no more if fewer than one in six of its packings settle, or none of the first six:
// packings that do not settle take longest, and say nothing about its means.
//
// How many replicates a group needs follows only from the results of its first ones, or of those of
// its family: it is the same for any number of threads and shards, and after a kill.
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

/// How many replicates a group needs, given what came of those made, in their order; nullptr stands
/// for one that is not made yet. `bound` is the bias of settling that the requested error includes.
int replicates_called_for(const std::vector<const Outcome*>& made, const ErrorWish& wish,
                          const std::optional<ProtocolBias>& bound);

/// Which of the requested accuracies were reached, for the end of a run; empty if there are none.
std::string wishes_text(const Sweep& whole, const Outcomes& outcomes);

/// The part of a sweep that the packings made so far call for. Refers to the whole sweep, which has
/// the most replicates of every group; the part is the whole if no group may grow.
class GrowingSweep {
 public:
  GrowingSweep(const Sweep& whole, const Outcomes& made);
  GrowingSweep(Sweep&& whole, const Outcomes& made) = delete;

  const Sweep& now() const { return grows_ ? called_ : whole_; }

  /// Looks at all that is made by now; returns whether anything is newly called for.
  bool grow(const Outcomes& made);

  /// Which errors are as requested, from all that is made: `wishes_text` of the whole sweep.
  std::string wishes(const Outcomes& made) const { return wishes_text(whole_, made); }

 private:
  const Sweep& whole_;
  bool grows_;
  Sweep called_;  ///< empty if it does not grow
};

/// Each requested accuracy that no number of packings can reach, at the place where it is written:
/// the way of settling may bias the means by more, or a fit has fewer than three widths, or
/// includes groups with requests of their own, which it would have to follow.
Diagnostics unreachable_wishes(const Sweep& whole);

/// A note at each requested accuracy that holds for means of which no bound of settling is known,
/// so that it is one of the scatter alone.
Diagnostics notes_on_unbounded_wishes(const Sweep& whole);

/// What a sweep whose groups grow takes at most, from the costs of all its jobs.
std::string growth_text(const std::vector<Cost>& most);

}  // namespace grainsweep
