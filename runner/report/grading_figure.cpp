// The grading of the grains: which share of them is finer than each diameter.
#include <algorithm>
#include <set>

#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/tables/sizes.hpp"

namespace grainsweep {
namespace {

const std::string grading_table = "grading.csv";

using Graded = std::vector<GroupWithCurves>;

/// Settled groups whose sizes are a distribution.
std::vector<const Group*> graded_on(const Axes& axes) {
  std::vector<const Group*> graded = groups_on(axes);
  std::erase_if(graded, [](const Group* group) {
    return group->settled.empty() || !has_size_distribution(group->job);
  });
  return graded;
}

/// The column of diameters that is drawn: in the unit of the sweep if it has one.
std::string diameter_column(const GivenUnits& units) {
  return units ? "diameter_" + units->unit : "diameter";
}

/// The rows of sizes.csv. Where sizes are steps, each begins with a row of its own for the curve
/// that was asked for.
std::string grading_csv(const Graded& groups, const GivenUnits& units) {
  std::vector<std::string> header = {"curve",        "group", "diameter",   "asked", "packed",
                                     "packed_error", "slab",  "slab_error", "name"};
  if (units) header.push_back(diameter_column(units));
  std::string text = csv_line(header);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::vector<SizeLine> lines = mean_sizes(*groups[k]);
    const auto add = [&](double diameter, double asked, const std::vector<std::string>& measured) {
      std::vector<std::string> cells = {cell(k + 1), cell(groups[k]->number), short_cell(diameter),
                                        cell(asked)};
      cells.insert(cells.end(), measured.begin(), measured.end());
      cells.push_back(cell(title_of(*groups[k])));
      if (units) cells.push_back(short_cell(units->d * diameter));
      text += csv_line(cells);
    };
    const bool has_steps = !lines.empty() && lines.front().asked > 0.0;
    double below = 0.0;
    for (const SizeLine& line : lines) {
      if (has_steps) add(line.diameter, below, {"", "", "", ""});
      add(line.diameter, line.asked,
          {cell(line.packed.mean), cell(line.packed.error), cell(line.slab.mean),
           cell(line.slab.error)});
      below = line.asked;
    }
  }
  return text;
}

/// The axis of diameters, logarithmic where they span more than a decade.
std::string diameter_axis(const Graded& groups, const GivenUnits& units) {
  constexpr double decade = 10.0, room = 1.08;
  std::vector<double> diameters;
  for (const GroupWithCurves& group : groups) {
    for (const SizeLine& line : mean_sizes(*group)) {
      diameters.push_back((units ? units->d : 1.0) * line.diameter);
    }
  }
  std::string label =
      label_command("x", "diameter / " + (units ? printed_unit(*units) : std::string("d")));
  if (diameters.empty()) return label;
  const auto [least, most] = std::minmax_element(diameters.begin(), diameters.end());
  if (*most <= decade * *least) return label + range_command("x", range_of(diameters, 0.04));
  const double low = *least / room, high = *most * room;
  return label + "set logscale x\n" + range_command("x", {low, high}) +
         decade_tics_command("x", low, high);
}

/// "volume", or of several kinds of shares "number or volume".
std::string weights_text(const Graded& groups) {
  std::set<std::string> weights;
  for (const GroupWithCurves& group : groups) weights.insert(size_weight(group->job));
  std::string text;
  for (const std::string& weight : weights) text += (text.empty() ? "" : " or ") + weight;
  return text;
}

/// What was asked for as lines, what is there as points.
std::string grading_panel(const Graded& groups, const std::string& x, const std::string& column) {
  constexpr std::size_t most_with_bars = 100;
  std::vector<std::string> asked, measured;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const std::string line = " ls " + cell(k + 1);
    const bool has_bars = mean_sizes(*groups[k]).size() <= most_with_bars;
    asked.push_back(plot_part({grading_table, "curve", k + 1, x, "asked", "", "lines" + line}));
    measured.push_back(plot_part({grading_table, "curve", k + 1, x, column,
                                  has_bars ? column + "_error" : "", "points" + line}));
  }
  asked.insert(asked.end(), measured.begin(), measured.end());
  return plot_command(asked);
}

Bars share_bars(const Graded& groups, Spread SizeLine::*share) {
  Bars bars;
  for (const GroupWithCurves& group : groups) {
    for (const SizeLine& line : mean_sizes(*group)) {
      bars.push_back({(line.*share).mean, (line.*share).error});
    }
  }
  return bars;
}

}  // namespace

bool has_grading(const Axes& axes) { return !graded_on(axes).empty(); }

Figure grading_figure(const Axes& axes) {
  constexpr std::size_t most_gradings = 6;
  Figure figure{.name = "grading", .title = "Grain sizes, asked and packed", .caption = ""};
  const std::vector<const Group*> all = graded_on(axes);
  Graded groups;
  groups.reserve(most_gradings);
  for (const Group* group : evenly_spread(all, most_gradings)) {
    groups.emplace_back(*group, axes.folder);
  }
  figure.caption =
      "Share of the grains, by " + weights_text(groups) +
      ", that are no larger than a diameter. Lines: as asked for. Points: as packed, in the whole "
      "bed and in the measured slab, which φ and Z are of" +
      bars_text({share_bars(groups, &SizeLine::packed), share_bars(groups, &SizeLine::slab)}) +
      ". All numbers are in the folder's sizes.csv.";
  if (groups.size() < all.size()) {
    figure.caption += " " + cell(groups.size()) + " of " + cell(all.size()) +
                      " groups with a distribution of sizes are shown.";
  }
  figure.tables = {{grading_table, grading_csv(groups, axes.units)}};
  std::vector<KeyEntry> key;
  const auto titles = titles_of(groups, longest_entry, axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    key.push_back({"linespoints ls " + cell(k + 1), titles[k]});
  }
  const Panels panels(figure, 2, {1.0}, key, {.right = 24.0, .above = 26.0});
  const std::string x = diameter_column(axes.units);
  const auto titled = [](const std::string& title) {
    return "set title " + gnuplot_text(title) + " offset 0,-0.7 font ',11' noenhanced\n";
  };
  figure.commands =
      "set multiplot\n" + panels.key() + panels.place(0, 0) + diameter_axis(groups, axes.units) +
      "set yrange [-0.02:1.02]\n" + label_command("y", "share finer, by " + weights_text(groups)) +
      titled("in the whole bed") + grading_panel(groups, x, "packed") + panels.place(1, 0) +
      titled("in the measured slab") + grading_panel(groups, x, "slab");
  return figure;
}

}  // namespace grainsweep
