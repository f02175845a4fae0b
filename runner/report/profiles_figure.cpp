// Solid fraction and coordination number from wall to wall.
#include <algorithm>
#include <numbers>
#include <set>

#include "runner/report/figures.hpp"
#include "runner/report/html.hpp"
#include "runner/report/plots.hpp"
#include "runner/report/published_profiles.hpp"
#include "runner/tables/decays.hpp"
#include "runner/tables/profiles.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

constexpr std::size_t most_profiles = 3;
const std::string bins_table = "profiles.csv";

/// A coordination number as far as it is drawn: none that so few packings tell that its bar would
/// dwarf all others.
Spread shown_coordination(const Group& group, const Spread& coordination) {
  constexpr int fewest = 3;
  return coordination.n < std::min(fewest, group.counts.settled)
             ? Spread{no_number, no_number, 0, no_number, 0.0}
             : coordination;
}

std::string bins_csv(const std::vector<GroupWithCurves>& groups) {
  std::string text = csv_line({"panel", "group", "y", "solid_fraction", "large", "large_error",
                               "coordination", "coordination_error", "coordination_with_walls",
                               "coordination_with_walls_error", "name"});
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const MeanBin& bin : mean_profile(*groups[k], profile_across(*groups[k]))) {
      const Spread z = shown_coordination(*groups[k], bin.coordination),
                   with_walls = shown_coordination(*groups[k], bin.coordination_with_walls);
      text += csv_line({cell(k + 1), cell(groups[k]->number), cell((bin.low + bin.high) / 2.0),
                        cell(bin.solid_fraction.mean), cell(bin.large.mean), cell(bin.large.error),
                        cell(z.mean), cell(z.error), cell(with_walls.mean), cell(with_walls.error),
                        cell(title_of(*groups[k]))});
    }
  }
  return text;
}

/// What the panels of a row show of these, so that they have one range: `shown(group, bin)`.
template <class Shown>
Bars bars_in(const std::vector<GroupWithCurves>& groups, Shown shown) {
  Bars bars;
  for (const GroupWithCurves& group : groups) {
    for (const MeanBin& bin : mean_profile(*group, profile_across(*group))) {
      const Spread one = shown(*group, bin);
      bars.push_back({one.mean, one.error});
    }
  }
  return bars;
}

/// The solid fractions with bars.
Bars solid_bars(const std::vector<GroupWithCurves>& groups) {
  return bars_in(groups, [](const Group&, const MeanBin& bin) { return bin.large; });
}

/// The range of the panels above, in which solid fractions of all grains have no bars.
Range solid_range(const std::vector<GroupWithCurves>& groups,
                  const std::vector<PublishedPoints>& published) {
  std::vector<double> ends = shown_ends(solid_bars(groups));
  append_values(published, false, ends);
  for (const GroupWithCurves& group : groups) {
    for (const MeanBin& bin : mean_profile(*group, profile_across(*group))) {
      ends.push_back(bin.solid_fraction.mean);
    }
  }
  return range_of(ends, 0.06);
}

/// Both coordination numbers.
Bars coordination_bars(const std::vector<GroupWithCurves>& groups) {
  Bars bars;
  for (Spread MeanBin::*spread : {&MeanBin::coordination, &MeanBin::coordination_with_walls}) {
    const Bars some = bars_in(groups, [=](const Group& group, const MeanBin& bin) {
      return shown_coordination(group, bin.*spread);
    });
    bars.insert(bars.end(), some.begin(), some.end());
  }
  return bars;
}

/// The curve that describes the layers of large grains, from both walls to the middle.
std::string cosine(const DecayFit& fit, double width) {
  const std::string y = "(x < " + cell(width / 2.0) + " ? x : " + cell(width) + " - x)";
  return "(" + y + " < " + cell(decay_window_start) + " ? NaN : " + cell(fit.bulk.value) + " + " +
         cell(fit.amplitude.value) + " * exp(-" + y + " / " + cell(fit.length.value) + ") * cos(" +
         cell(2.0 * std::numbers::pi / fit.period.value) + " * " + y + " + " +
         cell(fit.phase.value) + "))";
}

/// Whether there are grains of two classes; else solid fractions of large grains are of all.
bool has_classes(const std::vector<GroupWithCurves>& groups) {
  return std::any_of(groups.begin(), groups.end(), [](const GroupWithCurves& group) {
    const auto bins = mean_profile(*group, profile_across(*group));
    return std::any_of(bins.begin(), bins.end(),
                       [](const MeanBin& bin) { return bin.small.mean > 0.0; });
  });
}

/// What the points are.
std::string measured_phi(const std::vector<GroupWithCurves>& groups) {
  return has_classes(groups) ? "φ of large grains" : "φ";
}

std::string solid_panel(std::size_t k, const DecayFit& fit, double width, bool with_all,
                        const std::vector<PublishedPoints>& published) {
  std::vector<std::string> parts = {
      plot_part({bins_table, "panel", k + 1, "y", "large", "large_error", "points ls 20"})};
  if (with_all) {
    parts.insert(parts.begin(), plot_part({bins_table, "panel", k + 1, "y", "solid_fraction", "",
                                           "lines ls 3 lw 0.8"}));
  }
  if (fit.not_determined.empty()) {
    parts.push_back(cosine(fit, width) + " with lines ls 2 lw 1.4 notitle");
  }
  append_published(k, false, published, parts);
  return plot_command(parts);
}

/// Marks show bins whose neighbours have no grains, too.
constexpr const char* without_walls_style = "linespoints ls 1 lw 1.4 ps 0.3";
constexpr const char* with_walls_style = "linespoints ls 5 lw 1.4 ps 0.3";

std::string coordination_panel(std::size_t k, const Group& group,
                               const std::vector<PublishedPoints>& published) {
  const auto curve = [&](const std::string& column, const char* style) {
    return plot_part({bins_table, "panel", k + 1, "y", column, column + "_error", style});
  };
  std::vector<std::string> parts = {curve("coordination", without_walls_style)};
  if (group.job.box.y == Boundary::walls) {
    parts.insert(parts.begin(), curve("coordination_with_walls", with_walls_style));
  }
  append_published(k, true, published, parts);
  return plot_command(parts);
}

std::string commands_of(Figure& figure, const std::vector<GroupWithCurves>& groups,
                        const std::vector<DecayFit>& fits,
                        const std::vector<PublishedPoints>& published, const Axes& axes) {
  const bool with_all = has_classes(groups);
  std::vector<KeyEntry> key = {{"points ls 20", measured_phi(groups)}};
  if (std::any_of(fits.begin(), fits.end(),
                  [](const DecayFit& fit) { return fit.not_determined.empty(); })) {
    key.push_back({"lines ls 2", "damped cosine"});
  }
  if (with_all) key.push_back({"lines ls 3", "φ of all grains"});
  if (bins_across(groups) == std::set{BinsAcross::slices_without_walls}) {
    key.push_back({without_walls_style, "Z"});
  } else {
    key.push_back({without_walls_style, "Z, walls not counted"});
    key.push_back({with_walls_style, "Z, walls counted"});
  }
  append_key(published, key);
  const Panels panels(figure, groups.size(), {0.55, 0.45}, key, {.right = 16.0, .above = 26.0});
  std::string text = "set multiplot\n" + panels.key();
  const std::string solid = range_command("y", solid_range(groups, published));
  std::vector<double> z_ends = shown_ends(coordination_bars(groups));
  append_values(published, true, z_ends);
  const std::string touching = range_command("y", range_of(z_ends, 0.06));
  const auto titles = titles_of(groups, panels.title_length(), axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const double width = groups[k]->job.box.width;
    text += panels_across(panels, k, titles[k], *groups[k],
                          solid + solid_panel(k, fits[k], width, with_all, published),
                          touching + coordination_panel(k, *groups[k], published));
  }
  return text;
}

/// What is fitted; nothing where there is no wall.
std::string curve_text(const std::set<BinsAcross>& bins) {
  const bool has_tubes = bins.contains(BinsAcross::rings);
  const bool has_gaps = bins.contains(BinsAcross::slices_between_walls);
  if (!has_tubes && !has_gaps) return "";
  const std::string from = has_gaps ? "from both walls" : "", to = "up to the axis";
  return " φ = bulk + A exp(-y / λ) cos(2π y / T + δ), y from the wall, is fitted " + from +
         (has_gaps && has_tubes ? ", in tubes " : "") + (has_tubes ? to : "") + ".";
}

std::string decay_text(const DecayFit& fit, const GivenUnits& units) {
  if (!fit.not_determined.empty()) return "no curve, " + with_signs(fit.not_determined);
  const bool is_within = why_no_reach(fit).empty();
  return "λ = " + length_text(fit.length.value, fit.length.error, 2, units) + ", reach " +
         (is_within ? length_text(fit.reach.value, fit.reach.error, 1, units)
                    : "beyond the middle") +
         (fit.misfit > largest_misfit
              ? ", but the damped cosine does not hold: its misfit is " + fixed(fit.misfit, 1)
              : "");
}

std::string decays_text(const std::vector<GroupWithCurves>& groups,
                        const std::vector<DecayFit>& fits, const Axes& axes) {
  std::string text;
  const auto titles = titles_of(groups, longest_entry, axes);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    text += " " + titles[k] + ": " + decay_text(fits[k], axes.units) + ".";
  }
  return text;
}

/// Whether bins are left out, and why.
std::string left_out_bins_text(const std::vector<GroupWithCurves>& groups) {
  const auto is_left_out = [](const Group& group, const MeanBin& bin) {
    return bin.coordination.n > 0 && shown_coordination(group, bin.coordination).n == 0;
  };
  const bool are_left_out =
      std::any_of(groups.begin(), groups.end(), [&](const GroupWithCurves& group) {
        const auto bins = mean_profile(*group, profile_across(*group));
        return std::any_of(bins.begin(), bins.end(),
                           [&](const MeanBin& bin) { return is_left_out(*group, bin); });
      });
  return are_left_out ? " Z of bins with grains in fewer than 3 packings, or of 2 packings in one, "
                        "is left out."
                      : "";
}

}  // namespace

Figure profiles_figure(const Axes& axes, const std::vector<Comparison>& comparisons) {
  Figure figure{.name = "profiles", .title = "Layers beside the walls", .caption = ""};
  const std::vector<GroupWithCurves> groups =
      chosen_walled_groups(axes, most_profiles, groups_with_published(comparisons));
  if (groups.empty()) return undrawn(std::move(figure), "no packing has settled");
  const std::set<BinsAcross> bins = bins_across(groups);
  if (bins == std::set{BinsAcross::slices_without_walls}) {
    figure.title = "Slices across the box";
  } else if (bins == std::set{BinsAcross::rings}) {
    figure.title = "Layers beside the wall";
  }
  std::vector<DecayFit> fits;
  fits.reserve(groups.size());
  for (const GroupWithCurves& group : groups) fits.push_back(decay_of(*group, GrainClass::large));
  figure.height = 520;
  const std::string few = few_of_all_text(groups.size(), axes);
  figure.caption = "Solid fraction and coordination number of " + bins_text(bins) +
                   bars_text({solid_bars(groups), coordination_bars(groups)},
                             " at " + measured_phi(groups) + " and Z") +
                   "." + left_out_bins_text(groups) + curve_text(bins) +
                   decays_text(groups, fits, axes) +
                   (few.empty() ? "" : few + " The others are in the folder's profiles.csv.");
  const std::vector<PublishedPoints> published = published_of(groups, comparisons);
  figure.tables = {{bins_table, bins_csv(groups)}};
  if (!published.empty()) {
    figure.tables.emplace_back(published_profiles_table, published_csv(published));
    figure.caption += " Published profiles stand over the distance from the wall.";
  }
  figure.commands = commands_of(figure, groups, fits, published, axes);
  return figure;
}

}  // namespace grainsweep
