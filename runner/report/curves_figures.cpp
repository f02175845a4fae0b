// Figures over other things than the axis of the sweep: distributions, small grains, effort.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>

#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/store/fields.hpp"
#include "runner/tables/decays.hpp"
#include "runner/tables/distributions.hpp"
#include "runner/tables/fits.hpp"
#include "runner/tables/profiles.hpp"

namespace grainsweep {
namespace {

constexpr std::size_t most_curves = 6;
constexpr double farthest = 4.0;  ///< d, to which g is drawn at most
constexpr int bins_to_mark = 4;   ///< from mark to mark along g, whose bins are many

constexpr std::size_t most_bars = 100;  // of a curve over the height

/// The mean profiles along z: bins are too few grains each for a coordination number.
std::vector<std::vector<MeanBin>> slices_of(const std::vector<GroupWithCurves>& groups) {
  std::vector<std::vector<MeanBin>> all;
  all.reserve(groups.size());
  for (const GroupWithCurves& group : groups) {
    all.push_back(mean_layers(*group, &PackingResult::profile_z, 1.0));
  }
  return all;
}

std::string heights_csv(const std::vector<GroupWithCurves>& groups,
                        const std::vector<std::vector<MeanBin>>& slices) {
  std::string text = csv_line({"curve", "group", "z", "solid_fraction", "solid_fraction_error",
                               "coordination", "coordination_error", "name"});
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const MeanBin& bin : slices[k]) {
      text += csv_line({cell(k + 1), cell(groups[k]->number), cell((bin.low + bin.high) / 2.0),
                        cell(bin.solid_fraction.mean), cell(bin.solid_fraction.error),
                        cell(bin.coordination.mean), cell(bin.coordination.error),
                        cell(title_of(*groups[k]))});
    }
  }
  return text;
}

bool have_bars(const std::vector<MeanBin>& bins) { return bins.size() <= most_bars; }

/// All means of these bins, and 0.
Bars slice_bars(const std::vector<std::vector<MeanBin>>& slices, Spread MeanBin::*spread) {
  Bars bars = {{0.0, no_number}};
  for (const auto& bins : slices) {
    for (const MeanBin& bin : bins) {
      bars.push_back({(bin.*spread).mean, have_bars(bins) ? (bin.*spread).error : no_number});
    }
  }
  return bars;
}

std::string curves_csv(const std::vector<GroupWithCurves>& groups) {
  std::string text = csv_line({"curve", "group", "x", "value", "error", "name"});
  const auto add = [&](Curve Curves::*curve, std::size_t first) {
    for (std::size_t k = 0; k < groups.size(); ++k) {
      for (const CurvePoint& point : mean_curve(*groups[k], curve)) {
        text += csv_line({cell(first + k), cell(groups[k]->number),
                          cell((point.low + point.high) / 2.0), cell(point.value.mean),
                          cell(point.value.error), cell(title_of(*groups[k]))});
      }
    }
  };
  add(&Curves::pair_correlation, 1);
  add(&Curves::force_density, 1 + groups.size());
  return text;
}

/// All values that the curves of these groups reach, and 0.
std::vector<double> curve_values(const std::vector<GroupWithCurves>& groups, Curve Curves::*curve) {
  std::vector<double> values = {0.0};
  for (const GroupWithCurves& group : groups) {
    for (const CurvePoint& point : mean_curve(*group, curve)) values.push_back(point.value.mean);
  }
  return values;
}

/// How far the pair correlation of a group is known, d.
double known_to(const Group& group) {
  double end = 0.0;
  for (const CurvePoint& point : mean_curve(group, &Curves::pair_correlation)) {
    if (std::isfinite(point.value.mean)) end = std::max(end, point.high);
  }
  return end;
}

/// Ranges of both axes of the densities of forces: to the largest force, and all densities but 0.
std::string force_ranges(const std::vector<GroupWithCurves>& groups) {
  constexpr double room = 1.5;  // a factor, for the scale is logarithmic
  double largest = 0.0, least = 1.0, most = 1.0;
  for (const GroupWithCurves& group : groups) {
    for (const CurvePoint& point : mean_curve(*group, &Curves::force_density)) {
      if (!(point.value.mean > 0.0)) continue;
      largest = std::max(largest, point.high);
      least = std::min(least, point.value.mean);
      most = std::max(most, point.value.mean);
    }
  }
  if (largest == 0.0) return "set xrange [0:1]\nset yrange [0.1:1]\n";
  return range_command("x", {0.0, largest}) + range_command("y", {least / room, room * most});
}

/// The families with different shares of small grains, by share.
std::multimap<double, const Family*> by_small_share(const std::vector<Family>& families) {
  std::multimap<double, const Family*> sorted;
  for (const Family& family : families) {
    if (!family.walled.empty()) sorted.emplace(family.walled.front().job.small_share, &family);
  }
  return sorted;
}

struct EstimateCells {
  std::string value, error;
};

EstimateCells estimate_cells(const Estimate& estimate, const std::string& not_determined) {
  if (!not_determined.empty()) return {};
  return {cell(estimate.value), cell(estimate.error)};
}

/// What the walls do to a family.
struct WallReach {
  double small_share = 0.0;
  std::size_t mark = 0;  ///< how many families of this share come before it
  const Family* family = nullptr;
  WallFit phi, z;
  DecayFit large, small;  ///< at its widest gap
};

std::vector<WallReach> reaches_of(const std::multimap<double, const Family*>& families,
                                  const std::string& folder) {
  std::vector<WallReach> reaches;
  for (const auto& [share, family] : families) {
    const GroupWithCurves widest(family->walled.back(), folder);
    const bool is_another = !reaches.empty() && reaches.back().small_share == share;
    const std::size_t mark = is_another ? reaches.back().mark + 1 : 0;
    reaches.push_back({share, mark, family, fit_walls(*family, Quantity::solid_fraction),
                       fit_walls(*family, Quantity::coordination),
                       decay_of(*widest, GrainClass::large), decay_of(*widest, GrainClass::small)});
  }
  return reaches;
}

std::string small_share_csv(const std::vector<WallReach>& reaches) {
  std::string text =
      csv_line({"mark", "small_share", "C", "C_error", "C_Z", "C_Z_error", "reach_large",
                "reach_large_error", "reach_small", "reach_small_error", "family"});
  for (const auto& [share, mark, family, phi, z, large, small] : reaches) {
    std::vector<std::string> cells = {cell(mark + 1), cell(share)};
    for (const auto& [value, error] :
         {estimate_cells(phi.slope, phi.not_determined), estimate_cells(z.slope, z.not_determined),
          estimate_cells(large.reach, why_no_reach(large)),
          estimate_cells(small.reach, why_no_reach(small))})
      cells.insert(cells.end(), {value, error});
    cells.push_back(cell(family->name));
    text += csv_line(cells);
  }
  return text;
}

/// For each group, by its parameters and label, the number of its series if that is shown.
std::map<std::pair<std::string, std::string>, std::size_t> series_numbers(const Axes& axes) {
  std::map<std::pair<std::string, std::string>, std::size_t> numbers;
  std::size_t number = 0;
  for (const Series* series : shown_series(axes)) {
    ++number;
    for (const Group* group : series->groups) {
      numbers[{group->job.label, group->job.parameters.text()}] = number;
    }
  }
  return numbers;
}

/// Measured packings, evenly spread over all.
std::vector<std::reference_wrapper<const Row>> points_of(const std::vector<Row>& rows) {
  std::vector<std::reference_wrapper<const Row>> all;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(all), is_measured);
  return evenly_spread(all, most_points);
}

// Numbers of what is drawn beside the series of the key.
constexpr std::size_t not_settled = most_series + 1, other_series = most_series + 2;

using SeriesNumbers = decltype(series_numbers(std::declval<const Axes&>()));

/// The number that a packing is drawn with.
std::size_t drawn_as(const Row& row, const SeriesNumbers& numbers) {
  if (!is_settled(row)) return not_settled;
  const auto number = numbers.find({row.job.label, row.job.parameters.text()});
  return number == numbers.end() ? other_series : number->second;
}

std::string effort_csv(const Axes& axes,
                       const std::vector<std::reference_wrapper<const Row>>& points) {
  std::string text =
      csv_line({"series", "job", "grains", "cpu_seconds", "contact_ratio", "status"});
  const auto numbers = series_numbers(axes);
  for (const Row& row : points) {
    text += csv_line({cell(drawn_as(row, numbers)), cell(row.job.id),
                      cell(row.outcome->result.grains), cell(row.outcome->cpu_seconds),
                      cell(number_of(field_named("contact_ratio"), *row.outcome)),
                      cell(status_of(row))});
  }
  return text;
}

/// The range of these, and 0.
Range range_from_0(const Bars& bars) {
  std::vector<double> ends = shown_ends(bars);
  ends.push_back(0.0);
  return range_of(ends, 0.2);
}

}  // namespace

Figure distributions_figure(const Axes& axes) {
  Figure figure{.name = "distributions",
                .title = "Distances and forces",
                .caption =
                    "Left: pair correlation. Right: probability density of a contact force "
                    "over the mean of its layer. Means over the settled replicates."};
  const std::vector<GroupWithCurves> groups = chosen_groups(axes, most_curves);
  if (groups.empty()) return undrawn(std::move(figure), "no packing has settled");
  const std::string table = "distributions.csv";
  figure.tables = {{table, curves_csv(groups)}};
  figure.caption += few_of_all_text(groups.size(), axes);
  double shortest = farthest, longest = 0.0;  // of the curves g, d
  for (const GroupWithCurves& group : groups) {
    shortest = std::min(shortest, known_to(*group));
    longest = std::max(longest, known_to(*group));
  }
  const double shown = longest > 0.0 ? std::min(longest, farthest) : farthest;
  if (shortest < farthest) {
    figure.caption +=
        " g ends at half a period or at an edge of the measured slab, whichever is shorter.";
  }
  std::vector<std::string> pairs, forces;
  std::vector<KeyEntry> key;
  const auto titles = titles_of(groups, longest_entry, axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::string style = "linespoints ls " + cell(k + 1);
    key.push_back({style, titles[k]});
    pairs.push_back(plot_part({table, "curve", k + 1, "x", "value", "",
                               style + " lw 1.3 ps 0.5 pi " + cell(bins_to_mark)}));
    forces.push_back(plot_part({table, "curve", k + 1 + groups.size(), "x", "value", "",
                                "linespoints ls " + cell(k + 1) + " lw 1 ps 0.5"}));
  }
  const Panels panels(figure, 2, {1.0}, key, {.right = 24.0});
  figure.commands =
      "set multiplot\n" + panels.key() + panels.place(0, 0) + range_command("x", {0.0, shown}) +
      label_command("x", "distance of centres, r / d") +
      label_command("y", "pair correlation g(r)") +
      range_command("y", range_of(curve_values(groups, &Curves::pair_correlation), 0.04)) +
      plot_command(pairs) + panels.place(1, 0) + force_ranges(groups) +
      "set logscale y\nset format y '10^{%T}'\n" +
      label_command("x", "force over the mean, f / <f>") +
      label_command("y", "probability density P(f)") + plot_command(forces);
  return figure;
}

Figure heights_figure(const Axes& axes) {
  Figure figure{
      .name = "heights",
      .title = "From the floor to the surface",
      .caption =
          "Solid fraction and coordination number (walls not counted) of slices about 1 d thick"};
  const std::vector<GroupWithCurves> groups = chosen_groups(axes, most_curves);
  if (groups.empty()) return undrawn(std::move(figure), "no packing has settled");
  const std::string table = "heights.csv";
  const auto slices = slices_of(groups);
  double highest = 1.0;
  for (const auto& bins : slices)
    highest = std::max(highest, bins.empty() ? 0.0 : bins.back().high);
  figure.tables = {{table, heights_csv(groups, slices)}};
  const Bars solid_bars = slice_bars(slices, &MeanBin::solid_fraction),
             touching_bars = slice_bars(slices, &MeanBin::coordination);
  figure.caption +=
      bars_text({solid_bars, touching_bars}, ", where there is room for them,") +
      ". What is measured as a bed's is the part between, away from floor and surface. Thinner "
      "slices are in the folder's profiles.csv." +
      few_of_all_text(groups.size(), axes);
  std::vector<std::string> solid, touching;
  std::vector<KeyEntry> key;
  const auto titles = titles_of(groups, longest_entry, axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::string style = "lines ls " + cell(k + 1);
    key.push_back({style, titles[k]});
    const auto curve_of = [&](const std::string& column) {
      return plot_part({table, "curve", k + 1, "z", column,
                        have_bars(slices[k]) ? column + "_error" : "", style});
    };
    solid.push_back(curve_of("solid_fraction"));
    touching.push_back(curve_of("coordination"));
  }
  const Panels panels(figure, 2, {1.0}, key, {.right = 24.0});
  constexpr double no_bound = std::numeric_limits<double>::infinity();
  const std::string z = range_command("x", {0.0, highest}) + label_command("x", "height, z / d");
  figure.commands =
      "set multiplot\n" + panels.key() + panels.place(0, 0) + z +
      label_command("y", "solid fraction φ") +
      range_command("y", within(range_of(shown_ends(solid_bars), 0.04), 0.0, 1.0)) +
      plot_command(solid) + panels.place(1, 0) + z + label_command("y", "coordination number Z") +
      range_command("y", within(range_of(shown_ends(touching_bars), 0.04), 0.0, no_bound)) +
      plot_command(touching);
  return figure;
}

Figure small_share_figure(const std::vector<Family>& families, const std::string& folder) {
  Figure figure{.name = "small_grains",
                .title = "Small grains",
                .caption = "Left: slope of the wall effect, φ = φ_bulk - C / " +
                           extent_symbol(families) +
                           ". Right: how far the layers reach from the walls of the widest gap "
                           "(where their amplitude has fallen to 5 % of the bulk), for large and "
                           "small grains"};
  const std::string table = "small_grains.csv";
  const auto sorted = by_small_share(families);
  const std::vector<WallReach> reaches = reaches_of(sorted, folder);
  figure.tables = {{table, small_share_csv(reaches)}};
  Bars slopes, lengths;
  std::size_t marks = 1;
  for (const WallReach& reach : reaches) {
    marks = std::max(marks, reach.mark + 1);
    const Estimate& slope = reach.phi.slope;
    if (reach.phi.not_determined.empty()) slopes.push_back({slope.value, slope.error});
    for (const DecayFit* fit : {&reach.large, &reach.small}) {
      if (why_no_reach(*fit).empty()) lengths.push_back({fit->reach.value, fit->reach.error});
    }
  }
  figure.caption += bars_text({slopes, lengths}) +
                    ". A family whose value is not determined has no point; fits.csv and "
                    "decays.csv say why. Nor has a reach beyond the middle of the gap.";
  if (marks > 1) {
    figure.caption += " Families of one share have different marks, in the order of " + table + ".";
  }
  const bool has_slopes = !slopes.empty(), has_lengths = !lengths.empty();
  if (!has_slopes && !has_lengths) {
    figure.not_drawn =
        "neither C nor the reach is determined in any family; fits.csv and "
        "decays.csv say why";
  }
  const Panels panels(figure, 2, {1.0},
                      {{"points ls 3", "C"},
                       {"points ls 1", "reach of large grains"},
                       {"points ls 2", "reach of small grains"}},
                      {.right = 24.0});
  const auto add_parts = [&](const std::string& column, int line, std::vector<std::string>& parts) {
    for (std::size_t k = 0; k < marks; ++k) {
      const std::string style = "points ls " + cell(line);
      parts.push_back(
          plot_part({table, "mark", k + 1, "small_share", column, column + "_error",
                     k == 0 ? style : style + " pt " + cell(mark_of(most_series - k))}));
    }
  };
  std::vector<std::string> slope_parts, reach_parts;
  add_parts("C", 3, slope_parts);
  add_parts("reach_large", 1, reach_parts);
  add_parts("reach_small", 2, reach_parts);
  const std::string x =
      range_command("x", range_of({sorted.begin()->first, sorted.rbegin()->first}, 0.08)) +
      label_command("x", "share of small grains in the solid volume");
  figure.commands = "set multiplot\n" + panels.key() + panels.place(0, 0) + x +
                    label_command("y", "C / d") + range_command("y", range_from_0(slopes)) +
                    written_in_panel(has_slopes ? "" : "C is determined in no family") +
                    plot_command(slope_parts) + panels.place(1, 0) + x +
                    label_command("y", "reach / d") +
                    range_command("y", {0.0, range_from_0(lengths).high}) +
                    written_in_panel(has_lengths ? "" : "the reach is determined in no family") +
                    plot_command(reach_parts);
  return figure;
}

Figure effort_figure(const Axes& axes, const std::vector<Row>& rows) {
  Figure figure{.name = "effort",
                .title = "Time and rest",
                .caption =
                    "Each packing: processor time, on a logarithmic axis, and how near it came to "
                    "exactly as many contacts as a bed at rest needs (1)."};
  const auto points = points_of(rows);
  if (points.empty()) return undrawn(std::move(figure), "no packing was measured");
  const std::string table = "effort.csv";
  figure.tables = {{table, effort_csv(axes, points)}};
  if (points.size() == most_points) {
    figure.caption += " " + cell(most_points) + " packings are drawn; all are in packings.csv.";
  }
  std::vector<KeyEntry> key = series_key(axes, "points");
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < key.size(); ++k) {
    parts.push_back(plot_part(
        {table, "series", k + 1, "cpu_seconds", "contact_ratio", "", "points ls " + cell(k + 1)}));
  }
  std::vector<double> seconds, ratios = {1.0};
  bool all_settled = true;
  const auto is_of_others = [&, numbers = series_numbers(axes)](const Row& row) {
    return drawn_as(row, numbers) == other_series;
  };
  if (std::any_of(points.begin(), points.end(), is_of_others)) {
    const std::string style = other_series_style;
    key.push_back({style, "other series"});
    parts.insert(parts.begin(), plot_part({table, "series", other_series, "cpu_seconds",
                                           "contact_ratio", "", style}));
  }
  for (const Row& row : points) {
    all_settled = all_settled && is_settled(row);
    seconds.push_back(std::log10(row.outcome->cpu_seconds));
    ratios.push_back(number_of(field_named("contact_ratio"), *row.outcome));
  }
  if (!all_settled) {
    key.push_back({"points lc rgb '#777777' pt 2", "did not settle"});
    parts.push_back(plot_part({table, "series", not_settled, "cpu_seconds", "contact_ratio", "",
                               "points lc rgb '#777777' pt 2"}));
  }
  const auto [fastest, slowest] = std::minmax_element(seconds.begin(), seconds.end());
  constexpr double two_tics = 0.8;  // decades, twice those between 2 and 5
  const double room = std::max(0.1, (two_tics - (*slowest - *fastest)) / 2.0);
  const double fastest_shown = std::pow(10.0, *fastest - room);
  const double slowest_shown = std::pow(10.0, *slowest + room);
  const Panels panels(figure, 1, {1.0}, key, {.right = 24.0});
  figure.commands =
      reference_colours(axes) + "set multiplot\n" + panels.key() + panels.place(0, 0) +
      "set logscale x\n" + range_command("x", {fastest_shown, slowest_shown}) +
      decade_tics_command("x", fastest_shown, slowest_shown) +
      range_command("y", range_of(ratios, 0.06)) +
      "set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lc rgb '#444444'\n" +
      label_command("x", "processor time / s") +
      label_command("y", "contacts over the isostatic number") + plot_command(parts);
  return figure;
}

std::vector<Figure> figures_of(const std::vector<Row>& rows, const Analysis& analysis,
                               const std::vector<Comparison>& comparisons,
                               const GivenUnits& units) {
  Axes axes = axes_of(analysis.groups);
  axes.units = units;
  axes.folder = analysis.folder;
  std::vector<Figure> figures;
  if (!axes.scattered.empty()) figures.push_back(parameters_figure(axes));
  figures.push_back(means_figure(axes, analysis.families, comparisons));
  figures.push_back(profiles_figure(axes, comparisons));
  const auto shares = by_small_share(analysis.families);
  if (!shares.empty() && shares.begin()->first < shares.rbegin()->first) {
    figures.push_back(small_share_figure(analysis.families, analysis.folder));
  }
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return is_mixture(row.job); })) {
    figures.push_back(components_figure(axes));
  }
  const bool has_kinds = std::any_of(rows.begin(), rows.end(), [](const Row& row) {
    return row.outcome && row.outcome->result.shape_order;
  });
  if (has_kinds) figures.push_back(contacts_figure(axes));
  figures.push_back(heights_figure(axes));
  if (has_grading(axes)) figures.push_back(grading_figure(axes));
  figures.push_back(distributions_figure(axes));
  figures.push_back(effort_figure(axes, rows));
  const auto is_value = [](const Comparison& one) {
    return !one.published.formula && !one.published.profile;
  };
  if (std::any_of(comparisons.begin(), comparisons.end(), is_value)) {
    figures.push_back(published_figure(comparisons));
  }
  return figures;
}

}  // namespace grainsweep
