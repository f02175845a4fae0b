// Solid fraction and coordination number along the axis of a sweep.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "runner/compare/formula.hpp"
#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/tables/fits.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

const std::string points_table = "means.csv", residuals_table = "means-residuals.csv",
                  published_table = "means-published.csv";

/// A published formula of what a panel shows.
struct PublishedCurve {
  std::string quantity;
  PublishedFormula formula;
  std::vector<double> widths;  ///< where it holds and packings are, d
  /// Places 1 / W or 1 / D, from the widest to the narrowest of these, and values there.
  std::vector<std::pair<double, double>> points = {};
};

std::vector<std::pair<double, double>> points_of(const PublishedCurve& curve) {
  constexpr int steps = 200;
  const auto [least, most] = std::minmax_element(curve.widths.begin(), curve.widths.end());
  const double first = 1.0 / *most, last = 1.0 / *least;
  std::vector<std::pair<double, double>> points;
  for (int k = 0; k <= (first < last ? steps : 0); ++k) {
    const double x = first + (last - first) * k / steps;
    const double value = value_of_formula(curve.formula.text, 1.0 / x);
    if (std::isfinite(value))
      points.emplace_back(x, curve.quantity == "porosity" ? 1.0 - value : value);
  }
  return points;
}

/// Each formula once, over the widths of all families that it is set beside.
std::vector<PublishedCurve> curves_of(const Axes& axes,
                                      const std::vector<Comparison>& comparisons) {
  std::vector<PublishedCurve> curves;
  for (const Comparison& one : comparisons) {
    const bool is_curve = one.published.formula && !one.along.empty();
    if (!is_over_width(axes) || !is_curve || !is_mean_of_width(one.published.quantity)) continue;
    const PublishedFormula& formula = *one.published.formula;
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const PublishedCurve& known) {
      return known.quantity == one.published.quantity && known.formula.text == formula.text &&
             known.formula.name == formula.name;
    });
    if (curve == curves.end()) {
      curve = curves.insert(curve, {one.published.quantity, formula, {}});
    }
    for (const Comparison& at : one.along) curve->widths.push_back(at.published.width);
  }
  for (PublishedCurve& curve : curves) curve.points = points_of(curve);
  return curves;
}

Quantity panel_of(const PublishedCurve& curve) {
  return curve.quantity == "Z" ? Quantity::coordination : Quantity::solid_fraction;
}

/// Whether the formula holds at a single width, so that it is a point.
bool is_point(const PublishedCurve& curve) {
  return !curve.points.empty() && curve.points.front().first == curve.points.back().first;
}

/// Greys and browns, apart from the colours of series; twelve of them. Points are stars.
std::string style_of_curve(const std::vector<PublishedCurve>& curves, std::size_t k) {
  constexpr std::array colours = {"#7a7a7a", "#8a6d3b", "#303030"};
  const std::string colour =
      std::string("lc rgb '") + colours.at(k / 4 % colours.size()) + "' lw 1.4";
  return is_point(curves[k]) ? "points " + colour + " pt 3 ps 1.6"
                             : "lines " + colour + " dt " + cell(k % 4 + 2);
}

std::string curves_csv(const std::vector<PublishedCurve>& curves) {
  std::string text = csv_line({"curve", "x", "value", "name"});
  for (std::size_t k = 0; k < curves.size(); ++k) {
    for (const auto& [x, value] : curves[k].points) {
      text += csv_line({cell(k + 1), cell(x), cell(value), cell(curves[k].formula.name)});
    }
  }
  return text;
}

/// A series with the fits of its family.
struct FittedSeries {
  const Series* series = nullptr;
  std::optional<WallFit> phi, z;
};

bool is_determined(const std::optional<WallFit>& fit) { return fit && fit->not_determined.empty(); }

bool is_doubted(const std::optional<WallFit>& fit) {
  return is_determined(fit) && !fit->doubt.empty();
}

/// The family whose packings between walls are those of the series; null if there is none.
const Family* family_of(const Series& series, const std::vector<Family>& families) {
  for (const Family& family : families) {
    const auto is_in = [&](const Group& group) {
      return group.number == series.groups.front()->number;
    };
    if (std::any_of(family.walled.begin(), family.walled.end(), is_in)) return &family;
  }
  return nullptr;
}

std::vector<FittedSeries> fitted(const Axes& axes, const std::vector<Family>& families) {
  std::vector<FittedSeries> all;
  for (const Series* series : shown_series(axes)) {
    FittedSeries one{series, std::nullopt, std::nullopt};
    const bool may_have_fit = is_over_width(axes) && !series->is_scattered;
    const Family* family = may_have_fit ? family_of(*series, families) : nullptr;
    if (family != nullptr) {
      one.phi = fit_walls(*family, Quantity::solid_fraction);
      one.z = fit_walls(*family, Quantity::coordination);
    }
    all.push_back(std::move(one));
  }
  return all;
}

/// As many residuals of each line as its series has points.
void thin_residuals(std::vector<FittedSeries>& all) {
  for (FittedSeries& one : all) {
    for (auto* fit : {&one.phi, &one.z}) {
      if (*fit) (*fit)->points = evenly_spread((*fit)->points, one.series->groups.size());
    }
  }
}

/// Where packings without a gap between walls stand on the axis.
std::string places_text(const Axes& axes) {
  bool has_open = false, has_tubes = false, has_gaps = false;
  for (const Group* group : groups_on(axes)) {
    const Box& box = group->job.box;
    has_tubes = has_tubes || box.is_tube;
    has_open = has_open || (!box.is_tube && box.y == Boundary::periodic);
    has_gaps = has_gaps || (!box.is_tube && box.y == Boundary::walls);
  }
  const std::string text = has_open ? " Packings without walls along y stand at d / W = 0." : "";
  return text + (has_tubes && (has_open || has_gaps) ? " Tubes stand at d / D." : "");
}

/// Whether its packings lack what is along the axis, so that it has no point.
bool lacks_place(const Axes& axes, const Series& series) {
  return std::isnan(abscissa(axes, *series.groups.front()));
}

std::string lacking_text(const Axes& axes) {
  std::string names;
  for (const Series& series : axes.series) {
    if (lacks_place(axes, series)) names += (names.empty() ? "" : "; ") + series.name;
  }
  const std::string lacked = find_parameter(axes.parameter) ? axes.parameter : axes.title;
  return names.empty() ? "" : " No point for " + names + ": without " + lacked + ".";
}

std::string points_csv(const Axes& axes) {
  std::string text =
      csv_line({"series", "group", "x", "value", "solid_fraction", "solid_fraction_error",
                "coordination", "coordination_error", "name"});
  for (const Series& series : axes.series) {
    const std::string number = series_cell(axes, series);
    for (const Group* group : series.groups) {
      const Spread &phi = mean_of(*group, "solid_fraction"), &z = mean_of(*group, "coordination");
      text += csv_line({number, cell(group->number), cell(abscissa(axes, *group)),
                        cell(place_on(axes, *group)), cell(phi.mean), cell(phi.error), cell(z.mean),
                        cell(z.error), cell(series.name)});
    }
  }
  return text;
}

std::string residuals_csv(const std::vector<FittedSeries>& all) {
  std::string text = csv_line({"series", "quantity", "x", "residual", "error"});
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const auto* fit : {&all[k].phi, &all[k].z}) {
      if (!is_determined(*fit)) continue;
      for (const FitPoint& point : (*fit)->points) {
        text +=
            csv_line({cell(k + 1 + (fit == &all[k].z ? all.size() : 0)),
                      fit == &all[k].phi ? "solid_fraction" : "coordination",
                      cell(1.0 / point.width), cell(point.mean - point.fitted), cell(point.error)});
      }
    }
  }
  return text;
}

/// Where an axis of numbers other than widths has tics: groups are counted in whole ones.
std::string number_tics(const Axes& axes, const Range& range) {
  constexpr double most = 6.0;
  const double step = tic_step(range.high - range.low, most);
  return cell(axes.parameter.empty() ? std::max(1.0, step) : step);
}

/// The axis below, and above it the widths themselves where it is d / W or d / D.
std::string abscissa_commands(const Axes& axes, bool is_lowest, bool is_highest) {
  std::vector<double> at;
  std::set<double, std::greater<>> widths;
  for (const Group* group : groups_on(axes)) {
    at.push_back(abscissa(axes, *group));
    if (group->job.box.y == Boundary::walls) widths.insert(group->job.box.width);
  }
  if (is_over_width(axes)) at.push_back(0.0);
  const Range range = range_of(at, 0.06);
  std::string text = range_command("x", range);
  text += "set xtics " + (is_over_width(axes) ? "autofreq" : number_tics(axes, range)) + "\n";
  text += is_lowest ? "set format x\n" : "set format x ''\n";
  text += label_command("x", is_lowest ? abscissa_title(axes) : "");
  text += "unset x2tics\nunset x2label\n";
  if (!is_over_width(axes) || !is_highest) return text;
  std::string tics;
  double free_from = -1.0;  // where the last one ends
  const double character = 0.036 * *std::max_element(at.begin(), at.end());
  for (const double width : widths) {
    const std::string told = short_number(axes.units ? axes.units->d * width : width);
    const double half = character * (static_cast<double>(told.size()) + 1.0) / 2.0;
    if (1.0 / width - half < free_from) continue;
    free_from = 1.0 / width + half;
    tics += (tics.empty() ? "" : ", ") + gnuplot_text(told) + " " + cell(1.0 / width);
  }
  text += "set link x2\nset x2tics (" + tics + ") scale 0.6 out\n";
  const std::string unit = axes.units ? printed_unit(*axes.units) : "d";
  return text + "set x2label " + gnuplot_text(width_symbol(axes) + " / " + unit) +
         " offset 0,-0.6 noenhanced\n";
}

/// The means of the groups that have a place on the axis.
Bars placed_bars(const Axes& axes, Quantity quantity) {
  Axes placed = axes;
  for (Series& series : placed.series) {
    std::erase_if(series.groups,
                  [&](const Group* group) { return std::isnan(abscissa(axes, *group)); });
  }
  return bars_of(placed, quantity);
}

/// Everything that the panel of a quantity shows, with its errors.
std::vector<double> heights_of(const Axes& axes, const std::vector<FittedSeries>& all,
                               const std::vector<PublishedCurve>& curves, Quantity quantity) {
  std::vector<double> heights = shown_ends(placed_bars(axes, quantity));
  for (const FittedSeries& one : all) {
    const auto& fit = quantity == Quantity::solid_fraction ? one.phi : one.z;
    if (is_determined(fit)) heights.push_back(fit->bulk.value);
  }
  // Of curves what is near the points: a formula may go anywhere where it does not hold.
  const Range near = range_of(heights, 0.5);
  for (const PublishedCurve& curve : curves) {
    if (panel_of(curve) != quantity) continue;
    for (const auto& [x, value] : curve.points) {
      if (value >= near.low && value <= near.high) heights.push_back(value);
    }
  }
  return heights;
}

/// Where on d / W a line is drawn: not where containers are that it leaves out.
std::string range_of_line(const WallFit& fit) {
  if (fit.narrow_widths == 0) return "x >= 0";
  double end = 0.0;
  for (const FitPoint& point : fit.points) end = std::max(end, 1.0 / point.width);
  constexpr double beyond = 1.05;  // the last point
  return "x >= 0 && x <= " + cell(beyond * end);
}

std::string mean_panel(const Axes& axes, const std::vector<FittedSeries>& all,
                       const std::vector<PublishedCurve>& curves, Quantity quantity) {
  const bool is_phi = quantity == Quantity::solid_fraction;
  const std::string column = is_phi ? "solid_fraction" : "coordination";
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < curves.size(); ++k) {
    if (panel_of(curves[k]) != quantity) continue;
    parts.push_back(
        plot_part({published_table, "curve", k + 1, "x", "value", "", style_of_curve(curves, k)}));
  }
  if (has_other_series(axes)) {
    parts.push_back(plot_part({points_table, "series", 0, "x", column, "", other_series_style}));
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string style = " ls " + cell(k + 1);
    const auto& fit = is_phi ? all[k].phi : all[k].z;
    if (is_determined(fit)) {
      parts.push_back(cell(fit->bulk.value) + " - (" + cell(fit->slope.value) + ") * (" +
                      range_of_line(*fit) + " ? x : NaN) with lines" + style +
                      (is_doubted(fit) ? " lw 1 dt 2" : " lw 1.4") + " notitle");
    } else if (!all[k].series->is_scattered) {
      parts.push_back(plot_part(
          {points_table, "series", k + 1, "x", column, "", "lines" + style + " lw 0.8 dt 3"}));
    }
    parts.push_back(plot_part(
        {points_table, "series", k + 1, "x", column, column + "_error", "points" + style}));
  }
  return plot_command(parts);
}

std::string residual_panel(const std::vector<FittedSeries>& all, Quantity quantity) {
  const bool is_phi = quantity == Quantity::solid_fraction;
  std::vector<std::string> parts = {"0 with lines lc rgb '#444444' lw 1 notitle"};
  Bars bars;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& fit = is_phi ? all[k].phi : all[k].z;
    if (!is_determined(fit)) continue;
    for (const FitPoint& point : fit->points) {
      bars.push_back({point.mean - point.fitted, point.error});
    }
    parts.push_back(plot_part({residuals_table, "series", k + 1 + (is_phi ? 0 : all.size()), "x",
                               "residual", "error", "points ls " + cell(k + 1)}));
  }
  double largest = 0.0;
  for (const double end : shown_ends(bars)) largest = std::max(largest, std::abs(end));
  return few_tics_command("y", largest) + plot_command(parts);
}

/// Solid fraction to the left of its panel, porosity to the right; or the coordination number.
std::string height_commands(const std::vector<double>& heights, Quantity quantity) {
  const Range range = range_of(heights, 0.07);
  const std::string text = "set ytics autofreq\n" + range_command("y", range);
  if (quantity == Quantity::coordination) {
    return text + label_command("y", "coordination number Z") + "unset y2tics\nunset y2label\n";
  }
  return text + label_command("y", "solid fraction φ") +
         range_command("y2", {1.0 - range.low, 1.0 - range.high}) + "set y2tics nomirror\n" +
         "set y2label 'porosity 1 - φ' offset -1,0 noenhanced\n";
}

/// What the panels show: series that have points, and published formulas.
std::vector<KeyEntry> means_key(const Axes& axes, const std::vector<PublishedCurve>& curves) {
  const std::vector<const Series*> shown = shown_series(axes);
  const std::vector<KeyEntry> all = key_with_others(axes);
  std::vector<KeyEntry> entries;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool has_points = k >= shown.size() || !lacks_place(axes, *shown[k]);
    if (has_points) entries.push_back(all[k]);
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    entries.push_back({style_of_curve(curves, k), curves[k].formula.name});
  }
  return entries;
}

std::string means_commands(const Axes& axes, Figure& figure, const std::vector<FittedSeries>& all,
                           const std::vector<PublishedCurve>& curves, bool has_fits) {
  const Panels panels(figure, 2, has_fits ? std::vector{0.74, 0.26} : std::vector{1.0},
                      means_key(axes, curves),
                      {.right = 104.0, .above = is_over_width(axes) ? 58.0 : 8.0});
  std::string text = reference_colours(axes) + "set multiplot\n" + panels.key();
  for (const Quantity quantity : {Quantity::solid_fraction, Quantity::coordination}) {
    const std::size_t column = quantity == Quantity::solid_fraction ? 0 : 1;
    text += panels.place(column, 0) + abscissa_commands(axes, !has_fits, true) +
            height_commands(heights_of(axes, all, curves, quantity), quantity) +
            mean_panel(axes, all, curves, quantity) + "unset y2tics\nunset y2label\n";
    if (!has_fits) continue;
    text += panels.place(column, 1) + "unset link x2\n" + abscissa_commands(axes, true, false) +
            label_command("y", "residual") + residual_panel(all, quantity);
  }
  return text;
}

/// Reasons in the order in which they came up, and what they are of.
using NamesByReason = std::vector<std::pair<std::string, std::string>>;

void add_name(const std::string& reason, const std::string& name, NamesByReason& all) {
  const auto said =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == reason; });
  if (said == all.end()) {
    all.emplace_back(reason, name);
  } else {
    said->second += "; " + name;
  }
}

/// Which families have no line and why, each reason once.
std::string fits_text(const std::vector<FittedSeries>& all) {
  NamesByReason names_by_reason;
  for (const FittedSeries& one : all) {
    if (!one.phi || is_determined(one.phi)) continue;
    add_name(one.phi->not_determined, one.series->name, names_by_reason);
  }
  std::string text;
  for (const auto& [reason, names] : names_by_reason) {
    text += " No line for " + names + ": " + reason + ".";
  }
  return text;
}

/// Which lines leave out narrow containers.
std::string narrow_text(const std::vector<FittedSeries>& all) {
  std::string names;
  for (const FittedSeries& one : all) {
    if (!one.phi || one.phi->narrow_widths == 0) continue;
    names += (names.empty() ? "" : "; ") + one.series->name;
  }
  if (names.empty()) return "";
  return std::string(" Lines leave out narrow containers ") + narrow_containers + ": " + names +
         ".";
}

/// Which lines are in doubt and why, each doubt once.
std::string doubts_text(const std::vector<FittedSeries>& all) {
  NamesByReason names_by_doubt;
  for (const FittedSeries& one : all) {
    const std::string& name = one.series->name;
    const bool phi = is_doubted(one.phi), z = is_doubted(one.z);
    if (phi && z && one.phi->doubt == one.z->doubt) {
      add_name(one.phi->doubt, name + " (φ and Z)", names_by_doubt);
      continue;
    }
    if (phi) add_name(one.phi->doubt, name + " (φ)", names_by_doubt);
    if (z) add_name(one.z->doubt, name + " (Z)", names_by_doubt);
  }
  std::string text;
  for (const auto& [doubt, names] : names_by_doubt) {
    text += " Dashed, since " + doubt + ": " + names + ".";
  }
  return text;
}

std::string published_text(const std::vector<PublishedCurve>& curves) {
  if (curves.empty()) return "";
  const auto points = std::count_if(curves.begin(), curves.end(), is_point);
  return points == 0                    ? " Dashed: published formulas."
         : points == std::ssize(curves) ? " Stars: published formulas at their only width."
                                        : " Grey and brown: published formulas, as a star where "
                                          "they hold at one width.";
}

}  // namespace

Figure means_figure(const Axes& axes, const std::vector<Family>& families,
                    const std::vector<Comparison>& comparisons) {
  const Axes drawn = thinned(axes, most_points / 2);
  Figure figure{.name = "means",
                .title = is_over_width(drawn) ? "What the walls cost"
                                              : "Solid fraction and coordination number",
                .caption = "Means over the settled replicates" +
                           bars_text({placed_bars(drawn, Quantity::solid_fraction),
                                      placed_bars(drawn, Quantity::coordination)}) +
                           "."};
  std::vector<FittedSeries> all = fitted(drawn, families);
  if (!thinned_text(drawn, axes).empty()) thin_residuals(all);
  if (all.empty()) return undrawn(std::move(figure), "no packing has settled");
  const bool has_fits = std::any_of(all.begin(), all.end(), [](const FittedSeries& one) {
    return is_determined(one.phi) || is_determined(one.z);
  });
  if (has_fits) {
    const std::string extent = extent_symbol(families);
    figure.caption += " Lines: φ = φ_bulk - C / " + extent + " and Z = Z_bulk - C_Z / " + extent +
                      ", fitted to the packings " + (extent == "D" ? "in tubes" : "between walls") +
                      "; below, what the points differ from "
                      "their line." +
                      doubts_text(all);
    figure.height = 560;
    figure.tables.emplace_back(residuals_table, residuals_csv(all));
  }
  const std::vector<PublishedCurve> curves = curves_of(drawn, comparisons);
  if (!curves.empty()) {
    figure.caption += published_text(curves);
    figure.tables.emplace_back(published_table, curves_csv(curves));
  }
  if (is_over_width(drawn)) figure.caption += places_text(drawn);
  figure.caption += lacking_text(drawn) + fits_text(all) + narrow_text(all) +
                    grey_series_text(drawn) + thinned_text(drawn, axes);
  figure.tables.insert(figure.tables.begin(), {points_table, points_csv(drawn)});
  figure.commands = means_commands(drawn, figure, all, curves, has_fits);
  return figure;
}

}  // namespace grainsweep
