// Fits that grow: packings are added to the widths of a family until the errors of its wall effect,
//
//   phi = phi_bulk - C / W,     Z = Z_bulk - C_Z / W,
//
// are as small as requested. A packing has the weight w, one over its variance, and each next
// packing goes where, for the volume of slab that it takes, it most reduces the variance of the
// coefficient that is furthest from its request: with f = (1, 1 / W), M = sum n w f f^T over the
// widths, and e the coefficient, one more packing at f takes w (e^T M^-1 f)^2 / (1 + w f^T M^-1 f)
// from e^T M^-1 e (Sherman and Morrison). So packings end up at the narrowest and the widest gap;
// those between keep the number they began with.
//
// A width at which fewer than one in six packings settle gets no more of them, and a family with
// fewer than three widths at which any settle does not grow.
//
// The errors are those of fits.csv before they are widened: more packings do not mend a line that
// misses its points.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/dynamics/presets.hpp"
#include "runner/store/outcome.hpp"
#include "runner/sweep/error_wish.hpp"

namespace grainsweep {

/// A group of a family.
struct FitGroup {
  std::size_t mean = 0;     ///< which mean of groups.csv its packings enter: seeds share one
  double width = 0.0;       ///< d
  double floor_area = 0.0;  ///< of its container, d^2
  bool is_walled = false;  ///< whether it may be on the line; others only show how packings scatter
  bool may_grow = false;   ///< otherwise all its packings are made
  /// What came of its packings, in their order; nullptr stands for one that is not made yet.
  std::vector<const Outcome*> made = {};
  bool is_narrow = false;  ///< whether no line need hold there
};

/// What a family calls for, and what came of it.
struct CalledFit {
  std::vector<int> replicates;      ///< of each group
  bool is_made = false;             ///< whether all of them are
  bool is_met = false;              ///< whether the errors are as asked for, if they are made
  bool settles_too_seldom = false;  ///< whether that is why they are not, if they are made
  bool tells_errors = true;         ///< whether they scatter; if not, more of them give no error
  /// The worst error as fits.csv has it, widened where the line misses its points, over what is
  /// asked for; 0 without a line.
  double over_widened = 0.0;
};

/// How many replicates each group needs. They come in whole rounds: the first is `first_replicates`
/// of every group, and each further one at most doubles the family. `bound` is the bias of settling
/// that requested errors of bulk values include; what it does to slopes was not measured.
CalledFit called_for_fit(const std::vector<FitGroup>& groups, const FitWish& wish,
                         const std::optional<ProtocolBias>& bound);

}  // namespace grainsweep
