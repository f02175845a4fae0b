#include "runner/tables/profiles.hpp"

#include <algorithm>
#include <cmath>

namespace grainsweep {
namespace {

using Bins = std::vector<const ProfileBin*>;

double grains_in(const ProfileBin& bin) {
  return static_cast<double>(bin.large_grains + bin.small_grains);
}

/// The spread of `value(bin)` over the bins that hold grains.
template <class Value>
Spread spread_per_grain(const Bins& bins, Value value) {
  return spread_of_each(bins, [=](const ProfileBin& bin) {
    return static_cast<double>(value(bin)) / grains_in(bin);  // 0 / 0 is NaN
  });
}

MeanBin mean_bin(const Bins& bins, double low, double high) {
  MeanBin mean;
  mean.low = low;
  mean.high = high;
  mean.solid_fraction =
      spread_of_each(bins, [](const ProfileBin& bin) { return bin.large + bin.small; });
  mean.large = spread_of_each(bins, [](const ProfileBin& bin) { return bin.large; });
  mean.small = spread_of_each(bins, [](const ProfileBin& bin) { return bin.small; });
  mean.coordination = spread_per_grain(bins, [](const ProfileBin& bin) { return bin.neighbours; });
  mean.coordination_with_walls =
      spread_per_grain(bins, [](const ProfileBin& bin) { return bin.neighbours + bin.walls; });
  mean.small_number_share =
      spread_per_grain(bins, [](const ProfileBin& bin) { return bin.small_grains; });
  return mean;
}

struct ProfileLine {
  const Group& group;
  const char* axis = "";
  MeanBin bin;
};

Columns<ProfileLine> profile_bin_columns() {
  using Line = const ProfileLine&;
  return {
      {"axis", "", profile_axis_meaning, [](Line line) { return cell(line.axis); }},
      {"low", "d", "where the bin begins", [](Line line) { return short_cell(line.bin.low); }},
      {"high", "d", "where it ends", [](Line line) { return short_cell(line.bin.high); }},
      {"from_axis", "d", "distance of its middle from the axis of a tube; empty elsewhere",
       [](Line line) {
         return short_cell(from_axis(line.group, line.axis, line.bin.low, line.bin.high));
       }},
      {"n", "", "packings, those among them that end below the bin",
       [](Line line) { return cell(line.bin.solid_fraction.n); }},
      {"coordination_n", "", "those of them with grains whose centre is in the bin",
       [](Line line) { return cell(line.bin.coordination.n); }},
  };
}

Columns<ProfileLine> profile_line_columns(const Varied& varied, const GivenUnits& units) {
  Columns<ProfileLine> columns = columns_of_group<ProfileLine>(varied);
  append(columns, profile_bin_columns());
  const auto add = [&](const char* name, const char* meaning, Spread MeanBin::*spread) {
    append_spread(columns, name, "", meaning,
                  [=](const ProfileLine& line) { return line.bin.*spread; });
  };
  add("solid_fraction", "solid volume over the bin's volume", &MeanBin::solid_fraction);
  add("solid_fraction_large", "that of large grains", &MeanBin::large);
  add("solid_fraction_small", "that of small grains", &MeanBin::small);
  add("coordination", "touching grains per grain whose centre is in the bin",
      &MeanBin::coordination);
  add("coordination_with_walls", "the same, walls and floor counted",
      &MeanBin::coordination_with_walls);
  add("small_number_share", "small grains over all grains in the bin",
      &MeanBin::small_number_share);
  append_in_units(columns, units);
  return columns;
}

void append_bins(const Group& group, const char* axis, Profile PackingResult::*profile,
                 std::vector<ProfileLine>& lines) {
  for (const MeanBin& bin : mean_profile(group, profile)) lines.push_back({group, axis, bin});
}

Profile in_layers(const Profile& fine, double thickness) {
  const double bins = std::max(1.0, std::round(thickness / fine.bin_width));
  Profile coarse{bins * fine.bin_width, {}};
  for (std::size_t k = 0; k < fine.bins.size(); ++k) {
    if (k % static_cast<std::size_t>(bins) == 0) coarse.bins.emplace_back();
    const ProfileBin& from = fine.bins[k];
    ProfileBin& to = coarse.bins.back();
    to.large += from.large / bins;
    to.small += from.small / bins;
    to.large_grains += from.large_grains;
    to.small_grains += from.small_grains;
    to.neighbours += from.neighbours;
    to.walls += from.walls;
  }
  return coarse;
}

}  // namespace

double from_axis(const Group& group, std::string_view axis, double low, double high) {
  const Box& box = group.job.box;
  return box.is_tube && axis == "walls" ? box.width / 2.0 - (low + high) / 2.0 : no_number;
}

std::vector<MeanBin> mean_profile(const Group& group, Profile PackingResult::*profile) {
  std::vector<const Profile*> profiles;
  for (const Outcome& outcome : group.settled) profiles.push_back(&(outcome.result.*profile));
  return mean_bins(profiles, ProfileBin(), mean_bin);
}

std::vector<MeanBin> mean_layers(const Group& group, Profile PackingResult::*profile,
                                 double thickness) {
  std::vector<Profile> layers;
  layers.reserve(group.settled.size());
  for (const Outcome& outcome : group.settled) {
    layers.push_back(in_layers(outcome.result.*profile, thickness));
  }
  std::vector<const Profile*> profiles;
  profiles.reserve(layers.size());
  for (const Profile& one : layers) profiles.push_back(&one);
  return mean_bins(profiles, ProfileBin(), mean_bin);
}

CurveTable profiles_table(const Varied& varied, const GivenUnits& units) {
  return curve_table("profiles.csv", profile_line_columns(varied, units), [](const Group& group) {
    std::vector<ProfileLine> lines;
    append_bins(group, "x", &PackingResult::profile_x, lines);
    append_bins(group, "y", &PackingResult::profile_y, lines);
    append_bins(group, "walls", &PackingResult::profile_from_walls, lines);
    append_bins(group, "z", &PackingResult::profile_z, lines);
    return lines;
  });
}

}  // namespace grainsweep
