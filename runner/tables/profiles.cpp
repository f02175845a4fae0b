#include "runner/tables/profiles.hpp"

#include <algorithm>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using Bins = std::vector<const ProfileBin*>;

double grains_in(const ProfileBin& bin) {
  return static_cast<double>(bin.large_grains + bin.small_grains);
}

/// The spread of `value(bin)` over the bins that hold grains.
template <class Value>
Spread spread_per_grain(const Bins& bins, Value value) {
  std::vector<double> values;
  for (const ProfileBin* bin : bins) {
    if (grains_in(*bin) > 0) values.push_back(static_cast<double>(value(*bin)) / grains_in(*bin));
  }
  return spread_of(values);
}

template <class Value>
Spread spread_over(const Bins& bins, Value value) {
  std::vector<double> values;
  values.reserve(bins.size());
  for (const ProfileBin* bin : bins) values.push_back(value(*bin));
  return spread_of(values);
}

MeanBin mean_bin(const Bins& bins, double low, double high) {
  MeanBin mean;
  mean.low = low;
  mean.high = high;
  mean.solid_fraction =
      spread_over(bins, [](const ProfileBin& bin) { return bin.large + bin.small; });
  mean.large = spread_over(bins, [](const ProfileBin& bin) { return bin.large; });
  mean.small = spread_over(bins, [](const ProfileBin& bin) { return bin.small; });
  mean.coordination = spread_per_grain(bins, [](const ProfileBin& bin) { return bin.neighbours; });
  mean.coordination_with_walls =
      spread_per_grain(bins, [](const ProfileBin& bin) { return bin.neighbours + bin.walls; });
  mean.small_number_share =
      spread_per_grain(bins, [](const ProfileBin& bin) { return bin.small_grains; });
  return mean;
}

std::vector<std::string> spread_cells(const MeanBin& bin) {
  std::vector<std::string> cells;
  for (const Spread& spread : {bin.solid_fraction, bin.large, bin.small, bin.coordination,
                               bin.coordination_with_walls, bin.small_number_share}) {
    cells.push_back(cell(spread.mean));
    cells.push_back(cell(spread.sd));
  }
  return cells;
}

std::string lines_of(const Group& group, std::size_t number, const char* axis,
                     Profile PackingResult::*profile) {
  std::string text;
  for (const MeanBin& bin : mean_profile(group, profile)) {
    std::vector<std::string> cells = {cell(number),
                                      cell(group.job.label),
                                      cell(group.job.box.width),
                                      name_of(group.job.box.y),
                                      cell(group.job.small_share),
                                      axis,
                                      cell(bin.low),
                                      cell(bin.high),
                                      cell(bin.solid_fraction.n),
                                      cell(bin.coordination.n)};
    for (std::string& text_of_cell : spread_cells(bin)) cells.push_back(std::move(text_of_cell));
    text += csv_line(cells);
  }
  return text;
}

}  // namespace

std::vector<MeanBin> mean_profile(const Group& group, Profile PackingResult::*profile) {
  std::size_t longest = 0;
  for (const PackingResult& result : group.settled) {
    longest = std::max(longest, (result.*profile).bins.size());
  }
  std::vector<MeanBin> means;
  for (std::size_t k = 0; k < longest; ++k) {
    Bins bins;
    double width = 0.0;
    for (const PackingResult& result : group.settled) {
      const Profile& one = result.*profile;
      if (k < one.bins.size()) bins.push_back(&one.bins[k]), width = one.bin_width;
    }
    means.push_back(
        mean_bin(bins, static_cast<double>(k) * width, static_cast<double>(k + 1) * width));
  }
  return means;
}

std::string profiles_header() {
  return "group,label,width,boundary_y,small_share,axis,low,high,n,coordination_n,solid_fraction,"
         "solid_fraction_sd,solid_fraction_large,solid_fraction_large_sd,solid_fraction_small,"
         "solid_fraction_small_sd,coordination,coordination_sd,coordination_with_walls,"
         "coordination_with_walls_sd,small_number_share,small_number_share_sd\n";
}

std::string profile_lines(const Group& group, std::size_t number) {
  return lines_of(group, number, "y", &PackingResult::profile_y) +
         lines_of(group, number, "z", &PackingResult::profile_z);
}

}  // namespace grainsweep
