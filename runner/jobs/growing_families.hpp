// The groups of a sweep, and the families whose fit grows: what grows as a whole.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/job.hpp"

namespace grainsweep {

/// Whether the group of a job may grow.
bool may_grow(const Job& job);

/// Whether a group of the sweep may grow.
bool grows(const Sweep& sweep);

/// The jobs of a group, by their places in the sweep: those with one label, one parameter set, one
/// seed and one requested accuracy, wherever they stand.
using Places = std::vector<std::size_t>;

/// In the order of their first jobs.
std::vector<Places> groups_in(const Sweep& sweep);

/// The jobs with one label and one parameter set, by their places in the list; in the same order.
std::vector<Places> parameter_sets(const std::vector<Job>& jobs);

/// The groups that one wall effect is fitted to, by their places in the list of groups.
struct GrowingFamily {
  std::vector<std::size_t> groups;
  FitWish wish;  ///< the smallest of several for one fit
};

/// Families whose fit is to have small errors.
std::vector<GrowingFamily> growing_families(const Sweep& whole, const std::vector<Places>& groups);

/// Whether a job is on the line that is fitted to its family.
bool is_walled(const Job& job);

/// The bias that the way of settling may give the means of a job's group, 0 for a mean for which it
/// was not measured; nothing if it was measured for neither.
std::optional<ProtocolBias> bound_of(const Job& job);

/// Whether that bias was measured for all means whose accuracy a job requests, for its group or for
/// a fit to its family.
bool is_bounded(const Job& job, const ErrorWish& wish);
bool is_bounded(const Job& job, const FitWish& wish);

}  // namespace grainsweep
