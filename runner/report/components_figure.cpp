// What the components of mixtures do from wall to wall.
#include <algorithm>
#include <set>

#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/tables/component_names.hpp"
#include "runner/tables/component_profiles.hpp"
#include "runner/tables/components.hpp"

namespace grainsweep {
namespace {

constexpr std::size_t most_mixtures = 3;
const std::string components_table_name = "components.csv";

using Mixtures = std::vector<GroupWithCurves>;

std::vector<MeanComponentBin> profile_of(const Group& group, std::size_t component) {
  const auto across =
      group.job.box.is_tube ? &ComponentMeasure::profile_from_walls : &ComponentMeasure::profile_y;
  return mean_component_profile(group, across, component, component);
}

/// What selects a component's lines of the table.
std::size_t curve_number(std::size_t panel, std::size_t component) {
  return panel * most_components + component + 1;
}

std::string component_bins_csv(const Mixtures& groups) {
  std::string text =
      csv_line({"curve", "group", "component", "y", "solid_fraction", "solid_fraction_error",
                "coordination", "coordination_error", "name"});
  for (std::size_t panel = 0; panel < groups.size(); ++panel) {
    const Group& group = *groups[panel];
    for (std::size_t k = 0; k < components_of(group); ++k) {
      for (const MeanComponentBin& bin : profile_of(group, k)) {
        text += csv_line({cell(curve_number(panel, k)), cell(group.number), cell(k + 1),
                          cell((bin.low + bin.high) / 2.0), cell(bin.solid_fraction.mean),
                          cell(bin.solid_fraction.error), cell(bin.coordination.mean),
                          cell(bin.coordination.error), cell(title_of(group))});
      }
    }
  }
  return text;
}

/// All that the panels of a row show, so that they have one range.
std::vector<double> component_values_in(const Mixtures& groups, Spread MeanComponentBin::*spread) {
  std::vector<double> values;
  for (const GroupWithCurves& group : groups) {
    for (std::size_t k = 0; k < components_of(*group); ++k) {
      for (const MeanComponentBin& bin : profile_of(*group, k)) {
        values.push_back((bin.*spread).mean);
      }
    }
  }
  return values;
}

std::size_t shown_components(const Mixtures& groups) {
  std::size_t most = 0;
  for (const GroupWithCurves& group : groups) most = std::max(most, components_of(*group));
  return std::min(most, most_series);
}

/// Marks tell the lines apart where colours do not, and show bins whose neighbours have no grains:
/// dashes would look like those.
std::string component_style(std::size_t component) {
  return "linespoints ls " + cell(component + 1) + " lw 1.4 ps 0.45";
}

/// "sphere", or of several mixtures "sphere or cube".
std::string component_title(const Mixtures& groups, std::size_t component) {
  std::set<std::string> names;
  for (const GroupWithCurves& group : groups) {
    const std::vector<std::string> all = component_names(group->job);
    if (component < all.size()) names.insert(all[component]);
  }
  std::string title;
  for (const std::string& name : names) title += (title.empty() ? "" : " or ") + name;
  return title;
}

std::string component_panel(std::size_t number, const Group& group, const std::string& column) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < std::min(components_of(group), most_series); ++k) {
    parts.push_back(plot_part({components_table_name, "curve", curve_number(number, k), "y", column,
                               "", component_style(k)}));
  }
  return plot_command(parts);
}

std::string component_commands_of(Figure& figure, const Mixtures& groups, const Axes& axes) {
  std::vector<KeyEntry> key;
  for (std::size_t k = 0; k < shown_components(groups); ++k) {
    key.push_back({component_style(k), component_title(groups, k)});
  }
  const Panels panels(figure, groups.size(), {0.55, 0.45}, key, {.right = 16.0, .above = 26.0});
  const std::string solid = range_command(
      "y", range_of(component_values_in(groups, &MeanComponentBin::solid_fraction), 0.06));
  const std::string touching = range_command(
      "y", range_of(component_values_in(groups, &MeanComponentBin::coordination), 0.06));
  std::string text = "set multiplot\n" + panels.key();
  const auto titles = titles_of(groups, panels.title_length(), axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const Group& group = *groups[k];
    text += panels_across(panels, k, titles[k], group,
                          solid + component_panel(k, group, "solid_fraction"),
                          touching + component_panel(k, group, "coordination"));
  }
  return text;
}

}  // namespace

Figure components_figure(const Axes& axes) {
  Figure figure{.name = "components", .title = "Components across the packing", .caption = ""};
  const Mixtures groups = chosen_mixtures(axes, most_mixtures);
  if (groups.empty()) return undrawn(std::move(figure), "no packing has settled");
  const std::set<BinsAcross> bins = bins_across(groups);
  if (bins == std::set{BinsAcross::slices_between_walls}) {
    figure.title = "Components from wall to wall";
  } else if (bins == std::set{BinsAcross::rings}) {
    figure.title = "Components from the wall to the axis";
  }
  figure.caption =
      "Solid fraction of each component of a mixture, and how many grains of any "
      "component one of its own touches, in " +
      bins_text(bins) +
      ". The errors and the order of each component are in the folder's component_profiles.csv." +
      few_of_all_text(groups.size(), axes);
  figure.height = 520;
  figure.tables = {{components_table_name, component_bins_csv(groups)}};
  figure.commands = component_commands_of(figure, groups, axes);
  return figure;
}

}  // namespace grainsweep
