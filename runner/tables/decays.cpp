#include "runner/tables/decays.hpp"

#include <algorithm>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

double ProfileBin::*volume_of(GrainClass grains) {
  return grains == GrainClass::large ? &ProfileBin::large : &ProfileBin::small;
}

/// Both halves of every settled profile, from the wall inwards.
std::vector<std::vector<double>> halves_of(const Group& group, GrainClass grains) {
  std::vector<std::vector<double>> halves;
  for (const PackingResult& result : group.settled) {
    std::vector<double> values;
    for (const ProfileBin& bin : result.profile_y.bins) values.push_back(bin.*volume_of(grains));
    halves.push_back(values);
    std::reverse(values.begin(), values.end());
    halves.push_back(values);
  }
  return halves;
}

bool has_grains(const Group& group, GrainClass grains) {
  const auto is_filled = [&](const ProfileBin& bin) { return bin.*volume_of(grains) > 0.0; };
  return std::all_of(group.settled.begin(), group.settled.end(), [&](const PackingResult& result) {
    return std::any_of(result.profile_y.bins.begin(), result.profile_y.bins.end(), is_filled);
  });
}

std::string why_no_fit(const Group& group, GrainClass grains) {
  if (group.job.box.y == Boundary::periodic) return "there is no wall along y";
  if (group.settled.size() < 2) {
    return "needs 2 or more settled replicates to know the errors, has " +
           std::to_string(group.settled.size());
  }
  if (has_grains(group, grains)) return "";
  return grains == GrainClass::large ? "there are no large grains" : "there are no small grains";
}

std::vector<std::string> estimate_cells(const DecayFit& fit) {
  if (!fit.not_determined.empty()) return std::vector<std::string>(14);
  std::vector<std::string> cells;
  for (const Estimate& estimate :
       {fit.length, fit.bulk, fit.amplitude, fit.period, fit.phase, fit.reach}) {
    cells.push_back(cell(estimate.value));
    cells.push_back(cell(estimate.error));
  }
  cells.push_back(cell(fit.r_squared));
  cells.push_back(cell(fit.misfit));
  return cells;
}

std::string line_of(const Group& group, std::size_t number, GrainClass grains) {
  const DecayFit fit = decay_of(group, grains);
  std::vector<std::string> cells = {cell(number),
                                    cell(group.job.label),
                                    cell(group.job.box.width),
                                    name_of(group.job.box.y),
                                    cell(group.job.small_share),
                                    grains == GrainClass::large ? "large" : "small",
                                    fit.not_determined.empty() ? "determined" : "not determined",
                                    cell(fit.not_determined),
                                    cell(group.settled.size()),
                                    cell(decay_window_start),
                                    cell(fit.window_end),
                                    cell(fit.bins)};
  for (std::string& text : estimate_cells(fit)) cells.push_back(std::move(text));
  return csv_line(cells);
}

}  // namespace

DecayFit decay_of(const Group& group, GrainClass grains) {
  DecayFit fit;
  fit.window_end = group.job.box.width / 2.0;
  fit.not_determined = why_no_fit(group, grains);
  if (!fit.not_determined.empty()) return fit;
  const double bin_width = group.settled.front().profile_y.bin_width;
  return fit_decay(halves_of(group, grains), bin_width, fit.window_end);
}

std::string decays_header() {
  return "group,label,width,boundary_y,small_share,class,status,reason,packings,window_start,"
         "window_end,bins,lambda,lambda_error,bulk,bulk_error,amplitude,amplitude_error,period,"
         "period_error,phase,phase_error,reach,reach_error,r_squared,misfit\n";
}

std::string decay_lines(const Group& group, std::size_t number) {
  return line_of(group, number, GrainClass::large) + line_of(group, number, GrainClass::small);
}

}  // namespace grainsweep
