// profiles.csv: how solid fraction, coordination and the share of small grains change across the
// gap and from the floor up, mean and scatter over the replicates of each group.
#pragma once

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// A bin of a group's mean profile. A coordination or share counts the grains whose centre lies in
/// the bin; replicates without such grains do not enter it.
struct MeanBin {
  double low = 0.0, high = 0.0;  ///< d
  Spread solid_fraction;
  Spread large;  ///< solid fraction of the large class
  Spread small;
  Spread coordination;             ///< at the first gap tolerance, walls not counted
  Spread coordination_with_walls;  ///< the same, walls and floor counted
  Spread small_number_share;       ///< small grains over all grains
};

/// What the column `axis` of a table of profiles says.
inline constexpr const char* profile_axis_meaning =
    "x and y from wall to wall, x between walls only; walls, in ducts and tubes, "
    "from the nearest one inwards; z from the floor up";

/// Distance of the middle of a bin from the axis of a tube, d, for the profile from the walls,
/// which is called "walls"; NaN for others.
double from_axis(const Group& group, std::string_view axis, double low, double high);

/// What `mean(bins, low, high)` gives for the bins of each number, which lie from `low` to `high`,
/// d. Profiles end at the highest grain: where another one continues, the bins of a shorter one are
/// `beyond`, a bin without grains. A profile without any bins, of a bed that was not measured so,
/// takes no part.
template <class AnyProfile, class Bin, class Mean>
auto mean_bins(const std::vector<const AnyProfile*>& profiles, const Bin& beyond, Mean mean) {
  using Bins = std::vector<const Bin*>;
  std::size_t count = 0;
  for (const AnyProfile* one : profiles) count = std::max(count, one->bins.size());
  std::vector<std::invoke_result_t<Mean, const Bins&, double, double>> means;
  for (std::size_t k = 0; k < count; ++k) {
    Bins bins;
    double width = 0.0;
    for (const AnyProfile* one : profiles) {
      if (one->bins.empty()) continue;
      bins.push_back(k < one->bins.size() ? &one->bins[k] : &beyond);
      width = one->bin_width;
    }
    means.push_back(mean(bins, static_cast<double>(k) * width, static_cast<double>(k + 1) * width));
  }
  return means;
}

/// The mean of `profile` (profile_y or profile_z) over the settled packings of a group; above the
/// highest grain of a packing nothing is solid.
std::vector<MeanBin> mean_profile(const Group& group, Profile PackingResult::*profile);

/// The same in layers of as many bins as come nearest to `thickness`, d.
std::vector<MeanBin> mean_layers(const Group& group, Profile PackingResult::*profile,
                                 double thickness);

/// The file: along x and y, from the walls and along z of each group.
CurveTable profiles_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
