#include "runner/tables/decays.hpp"

#include <algorithm>

namespace grainsweep {
namespace {

double ProfileBin::*volume_of(GrainClass grains) {
  return grains == GrainClass::large ? &ProfileBin::large : &ProfileBin::small;
}

/// Every settled profile from a wall inwards: between two walls the mean of its halves, which share
/// grains in the middle and so are not two profiles; across a tube the profile itself.
std::vector<std::vector<double>> profiles_from_wall(const Group& group, GrainClass grains) {
  std::vector<std::vector<double>> profiles;
  for (const Outcome& outcome : group.settled) {
    const std::vector<ProfileBin>& bins = (outcome.result.*profile_across(group)).bins;
    std::vector<double>& values = profiles.emplace_back();
    for (std::size_t k = 0; k < bins.size(); ++k) {
      const double here = bins[k].*volume_of(grains);
      const double mirrored = bins[bins.size() - 1 - k].*volume_of(grains);
      values.push_back(group.job.box.is_tube ? here : 0.5 * (here + mirrored));
    }
  }
  return profiles;
}

/// Settled packings whose profile holds no grains of the class.
std::size_t packings_without(const Group& group, GrainClass grains) {
  const auto is_filled = [&](const ProfileBin& bin) { return bin.*volume_of(grains) > 0.0; };
  const auto lacks = [&](const Outcome& outcome) {
    const std::vector<ProfileBin>& bins = (outcome.result.*profile_across(group)).bins;
    return std::none_of(bins.begin(), bins.end(), is_filled);
  };
  return static_cast<std::size_t>(std::count_if(group.settled.begin(), group.settled.end(), lacks));
}

std::string why_no_fit(const Group& group, GrainClass grains) {
  if (group.job.box.y == Boundary::periodic) return "there is no wall along y";
  const std::size_t all = group.settled.size();
  if (all < 2) {
    return "needs 2 or more settled replicates to know the errors, has " + std::to_string(all);
  }
  const std::size_t lacking = packings_without(group, grains);
  if (lacking == 0) return "";
  const std::string what = grains == GrainClass::large ? "large grains" : "small grains";
  if (lacking == all) return "there are no " + what;
  return "no " + what + " in the slab of " + std::to_string(lacking) + " of " +
         std::to_string(all) + " packings; larger beds hold some";
}

struct DecayLine {
  const Group& group;
  GrainClass grains = GrainClass::large;
  DecayFit fit;
};

Columns<DecayLine> decay_status_columns() {
  using Line = const DecayLine&;
  return {
      {"class", "", "large or small grains",
       [](Line line) { return cell(line.grains == GrainClass::large ? "large" : "small"); }},
      fit_status_column<DecayLine>(),
      {"reason", "", "why it is not determined",
       [](Line line) { return cell(line.fit.not_determined); }},
      {"packings", "", "settled ones", [](Line line) { return cell(line.group.settled.size()); }},
      {"window_start", "d", "distance from the wall where the fit begins",
       [](Line /*line*/) { return cell(decay_window_start); }},
      {"window_end", "d", "where it ends", [](Line line) { return cell(line.fit.window_end); }},
      {"bins", "", "in the window", [](Line line) { return cell(line.fit.bins); }},
  };
}

Columns<DecayLine> decay_line_columns(const Varied& varied, const GivenUnits& units) {
  Columns<DecayLine> columns = columns_of_group<DecayLine>(varied);
  append(columns, decay_status_columns());
  const auto add = [&](const char* name, const char* unit, const char* meaning,
                       Estimate DecayFit::*estimate) {
    append_estimate(columns, name, unit, meaning, estimate);
  };
  add("lambda", "d", "length over which the oscillation decays", &DecayFit::length);
  add("bulk", "", "solid fraction far from the wall", &DecayFit::bulk);
  add("amplitude", "", "of the oscillation, extrapolated to the wall", &DecayFit::amplitude);
  add("period", "d", "of the oscillation", &DecayFit::period);
  add("phase", "rad", "of the oscillation at the wall", &DecayFit::phase);
  const auto reach_cell = [](double Estimate::*part) {
    return [=](const DecayLine& line) {
      return cell(why_no_reach(line.fit).empty() ? line.fit.reach.*part : no_number);
    };
  };
  columns.push_back({"reach", "d",
                     "where the amplitude has fallen to 5 % of bulk, of these grains alone; empty "
                     "if that is beyond window_end",
                     reach_cell(&Estimate::value)});
  columns.push_back({"reach_error", "d", "standard error of it", reach_cell(&Estimate::error)});
  columns.push_back({"r_squared", "",
                     "share of the mean profile's variance that the curve explains",
                     fit_cell(&DecayFit::r_squared)});
  columns.push_back(
      {"misfit", "",
       "root mean square of the residuals over that of the mean's errors, which are not widened "
       "here; above 2 a damped cosine does not describe the layers",
       fit_cell(&DecayFit::misfit)});
  append_in_units(columns, units);
  return columns;
}

}  // namespace

Profile PackingResult::*profile_across(const Group& group) {
  return group.job.box.is_tube ? &PackingResult::profile_from_walls : &PackingResult::profile_y;
}

DecayFit decay_of(const Group& group, GrainClass grains) {
  DecayFit fit;
  fit.window_end = group.job.box.width / 2.0;
  fit.not_determined = why_no_fit(group, grains);
  if (!fit.not_determined.empty()) return fit;
  const double bin_width = (group.settled.front().get().result.*profile_across(group)).bin_width;
  return fit_decay(profiles_from_wall(group, grains), bin_width, fit.window_end);
}

CurveTable decays_table(const Varied& varied, const GivenUnits& units) {
  return curve_table("decays.csv", decay_line_columns(varied, units), [](const Group& group) {
    std::vector<DecayLine> lines;
    for (const GrainClass grains : {GrainClass::large, GrainClass::small}) {
      lines.push_back({group, grains, decay_of(group, grains)});
    }
    return lines;
  });
}

}  // namespace grainsweep
