#include "runner/compare/wall_zone.hpp"

#include <algorithm>
#include <cmath>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

constexpr double least_core = 1.0;  // d

/// Mean coordination of the grains in the bins whose middle is so far from the nearer wall.
double coordination_between(const Profile& profile, double from, double to) {
  const auto bins = static_cast<double>(profile.bins.size());
  double grains = 0.0, neighbours = 0.0;
  for (std::size_t k = 0; k < profile.bins.size(); ++k) {
    const double bins_away = static_cast<double>(k) + 0.5;
    const double distance = std::min(bins_away, bins - bins_away) * profile.bin_width;
    if (distance < from || distance >= to) continue;
    const ProfileBin& bin = profile.bins[k];
    grains += static_cast<double>(bin.large_grains + bin.small_grains);
    neighbours += static_cast<double>(bin.neighbours);
  }
  return neighbours / grains;  // 0 / 0 is NaN
}

std::string why_no_zone(const Group& group) {
  const double needed = 2.0 * core_distance + least_core;
  if (group.job.box.is_tube) return "a tube has no flat walls";
  if (group.job.box.y == Boundary::periodic) return "there is no wall along y";
  if (group.job.box.width < needed) {
    return "needs a gap of " + cell(needed) + " d or more between the walls, has " +
           cell(group.job.box.width);
  }
  if (group.settled.size() >= 2) return "";
  return "needs 2 or more settled replicates to know the errors, has " +
         std::to_string(group.settled.size());
}

}  // namespace

WallZone wall_zone(const Group& group) {
  WallZone zone;
  zone.not_determined = why_no_zone(group);
  if (!zone.not_determined.empty()) return zone;
  const double half = group.job.box.width / 2.0;
  std::vector<double> drops, widths;
  for (const Outcome& outcome : group.settled) {
    const Profile& profile = outcome.result.profile_y;
    const double wall = coordination_between(profile, 0.0, first_layer);
    const double core = coordination_between(profile, core_distance, half + 1.0);
    const double mean = coordination_between(profile, 0.0, half + 1.0);
    drops.push_back(core - wall);
    widths.push_back(half * (core - mean) / (core - wall));
  }
  zone.drop = spread_of(drops);
  zone.width = spread_of(widths);
  if (!std::isfinite(zone.drop.mean)) zone.not_determined = "no grain lies at the wall or far off";
  return zone;
}

}  // namespace grainsweep
