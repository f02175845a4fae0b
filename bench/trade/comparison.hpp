// How far the beds of each accuracy lie from those of the reference, for what cost.
#pragma once

#include <string>
#include <vector>

#include "bench/trade/scene.hpp"

namespace grainsweep::bench {

/// Differences of a setting from the reference: over starts that settle with both, or, where the
/// reference has been given more starts than the setting, of the means of all beds of each (there
/// is none of lambda).
struct Compared {
  const Setting* setting = nullptr;
  int made = 0, settled = 0;   ///< beds
  double cpu_seconds = 0.0;    ///< median
  double relative_cost = 0.0;  ///< that over the median of `balanced`; NaN if the scene has none
  MeanError solid_fraction, coordination, force_square;
  MeanError lambda;            ///< decay length of the layers beside a wall, d; NaN without walls
  double contact_ratio = 0.0;  ///< mean
  /// Means of the setting's own beds.
  MeanError own_solid_fraction, own_coordination, own_force_square;
  bool are_paired = true;
  bool on_front = false;  ///< no other setting beats it
};

/// Whether no more of `a` are left unsettled, and it costs less and, in solid fraction and
/// coordination number, lies nowhere further from the reference by more than a standard error, and
/// in one of them nearer by more than two.
bool beats(const Compared& a, const Compared& b);

/// In the order of the settings; refers to them.
std::vector<Compared> compare_settings(const Scene& scene);

/// Marks the rows that no other beats.
void mark_front(std::vector<Compared>& rows);

/// What the search for exact rest does to the beds that rest in steps: one for each exact setting
/// whose beginning is in the scene as well.
struct ExactChange {
  const Setting* exact = nullptr;
  const Setting* begins = nullptr;
  MeanError solid_fraction, coordination;
};
std::vector<ExactChange> exact_changes(const Scene& scene);

}  // namespace grainsweep::bench
