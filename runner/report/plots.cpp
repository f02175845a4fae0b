#include "runner/report/plots.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "runner/report/figure.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

bool has_settled(const Group* group) { return !group->settled.empty(); }

bool is_there(const Series& series) {
  return std::any_of(series.groups.begin(), series.groups.end(), has_settled);
}

/// Whether a key has no room for names that all begin with the same label.
bool has_no_room_for_label(const std::vector<const Series*>& shown) {
  const auto has_room = [](const Series* series) {
    return characters(series->name) <= longest_entry;
  };
  const auto shares_label = [&](const Series* series) {
    return !series->distinction.empty() &&
           series->groups.front()->job.label == shown.front()->groups.front()->job.label;
  };
  return !std::all_of(shown.begin(), shown.end(), has_room) &&
         std::all_of(shown.begin(), shown.end(), shares_label);
}

std::vector<const Group*> settled_groups(const Axes& axes) {
  std::vector<const Group*> all = groups_on(axes);
  std::erase_if(all, [](const Group* group) { return !has_settled(group); });
  return all;
}

/// At most `most` of them, evenly spread over all.
std::vector<GroupWithCurves> spread_over(const std::vector<const Group*>& all, std::size_t most,
                                         const std::string& folder) {
  std::vector<GroupWithCurves> chosen;
  for (const Group* group : evenly_spread(all, most)) chosen.emplace_back(*group, folder);
  return chosen;
}

bool has_error(const Bar& bar) {
  return std::isfinite(bar.value) && std::isfinite(bar.error) && bar.error > 0.0;
}

/// How long a bar of these may be within a frame.
double longest_shown(const Bars& bars) {
  constexpr double many_bars = 3.0;
  std::vector<double> values, errors;
  for (const Bar& bar : bars) {
    if (std::isfinite(bar.value)) values.push_back(bar.value);
    if (has_error(bar)) errors.push_back(bar.error);
  }
  if (errors.empty()) return 0.0;
  const auto middle = errors.begin() + std::ssize(errors) / 2;
  std::nth_element(errors.begin(), middle, errors.end());
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return std::max(*high - *low, many_bars * *middle);
}

}  // namespace

std::vector<const Group*> groups_on(const Axes& axes) {
  std::vector<const Group*> all;
  for (const Series& series : axes.series) {
    all.insert(all.end(), series.groups.begin(), series.groups.end());
  }
  return all;
}

double abscissa(const Axes& axes, const Group& group) {
  if (!is_over_width(axes)) return place_on(axes, group);
  return group.job.box.y == Boundary::periodic ? 0.0 : 1.0 / group.job.box.width;
}

std::string abscissa_title(const Axes& axes) {
  return is_over_width(axes) ? "d / " + width_symbol(axes) : axes.title;
}

std::vector<const Series*> shown_series(const Axes& axes) {
  std::vector<const Series*> shown;
  for (const Series& series : axes.series) {
    if (is_there(series) && shown.size() < most_series) shown.push_back(&series);
  }
  return shown;
}

bool has_other_series(const Axes& axes) {
  const auto all = std::count_if(axes.series.begin(), axes.series.end(), is_there);
  return static_cast<std::size_t>(all) > most_series;
}

std::string grey_series_text(const Axes& axes) {
  if (!has_other_series(axes)) return "";
  return " " + cell(most_series) + " of " + cell(axes.series.size()) +
         " series have marks of their own, the others are grey.";
}

std::string left_out_text(const Axes& axes, const std::string& name) {
  const std::size_t shown = shown_series(axes).size();
  if (shown < most_series || shown == axes.series.size()) return "";
  return " " + cell(shown) + " of " + cell(axes.series.size()) + " series are shown; all are in " +
         name + ".csv.";
}

Axes thinned(const Axes& axes, std::size_t most) {
  const std::size_t all = settled_groups(axes).size();
  if (all <= most) return axes;
  Axes drawn = axes;
  for (Series& series : drawn.series) {
    std::erase_if(series.groups, [](const Group* group) { return !has_settled(group); });
    const std::size_t share = std::max<std::size_t>(series.groups.size() * most / all, 1);
    series.groups = evenly_spread(series.groups, share);
  }
  std::erase_if(drawn.series, [](const Series& series) { return series.groups.empty(); });
  drawn.series = evenly_spread(drawn.series, most);
  return drawn;
}

std::string thinned_text(const Axes& drawn, const Axes& axes) {
  return few_of_all_text(settled_groups(drawn).size(), axes);
}

std::vector<GroupWithCurves> chosen_groups(const Axes& axes, std::size_t most) {
  return spread_over(settled_groups(axes), most, axes.folder);
}

std::vector<GroupWithCurves> chosen_walled_groups(const Axes& axes, std::size_t most,
                                                  const std::set<std::size_t>& numbers) {
  std::vector<const Group*> chosen = settled_groups(axes);
  const auto keep = [&](const auto& is_such) {
    std::vector<const Group*> such;
    std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(such), is_such);
    if (!such.empty()) chosen = such;
  };
  keep([](const Group* group) { return group->job.box.y == Boundary::walls; });
  keep([&](const Group* group) { return numbers.contains(group->number); });
  return spread_over(chosen, most, axes.folder);
}

std::vector<GroupWithCurves> chosen_mixtures(const Axes& axes, std::size_t most) {
  std::vector<const Group*> mixtures, all = settled_groups(axes);
  std::copy_if(all.begin(), all.end(), std::back_inserter(mixtures),
               [](const Group* group) { return is_mixture(group->job); });
  return spread_over(mixtures, most, axes.folder);
}

std::vector<std::string> titles_of(const std::vector<GroupWithCurves>& groups, std::size_t longest,
                                   const Axes& axes) {
  std::vector<const Group*> plain;
  plain.reserve(groups.size());
  for (const GroupWithCurves& group : groups) plain.push_back(&*group);
  return titles_of(plain, longest, groups_on(axes));
}

std::string few_of_all_text(std::size_t shown, const Axes& axes) {
  const std::size_t all = settled_groups(axes).size();
  return shown == all ? "" : " " + cell(shown) + " of " + cell(all) + " groups are shown.";
}

std::string series_cell(const Axes& axes, const Series& series) {
  const auto shown = shown_series(axes);
  const auto at = std::find(shown.begin(), shown.end(), &series);
  return at == shown.end() ? "" : cell(at - shown.begin() + 1);
}

std::string reference_colours(const Axes& axes) {
  std::string text;
  std::map<std::string, std::size_t> first_of;  // by family
  const std::vector<const Series*> shown = shown_series(axes);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const std::string& family = shown[k]->groups.front()->family_name;
    const auto [first, is_new] = first_of.emplace(family, k);
    if (!is_new && !shown[k]->is_scattered) text += series_style(k, first->second);
  }
  return text;
}

std::vector<KeyEntry> series_key(const Axes& axes, const std::string& style) {
  std::vector<KeyEntry> entries;
  const std::vector<const Series*> shown = shown_series(axes);
  const bool without_label = has_no_room_for_label(shown);
  entries.reserve(shown.size());
  for (const Series* series : shown) {
    entries.push_back({style + " ls " + cell(entries.size() + 1),
                       without_label ? series->distinction : series->name});
  }
  return entries;
}

std::vector<KeyEntry> key_with_others(const Axes& axes) {
  std::vector<KeyEntry> entries = series_key(axes, "points");
  if (has_other_series(axes)) entries.push_back({other_series_style, "other series"});
  return entries;
}

std::string plot_part(const Curve2d& curve) {
  const auto column = [](const std::string& name) {
    return "(column(" + gnuplot_text(name) + "))";
  };
  const std::string selected = curve.number == 0
                                   ? "strcol(" + gnuplot_text(curve.selector) + ") eq ''"
                                   : column(curve.selector) + "==" + cell(curve.number);
  const std::string points = gnuplot_text(curve.table) + " using (" + selected + " ? " +
                             column(curve.x) + " : NaN):(strcol(" + gnuplot_text(curve.y) +
                             ") eq '' ? NaN : " + column(curve.y) +
                             ")";  // a line ends where there is no value
  std::string plain = points + " with " + curve.style + " notitle";
  if (curve.error.empty()) return plain;
  std::string of_bars = curve.style.substr(curve.style.find(' ') + 1);
  of_bars.resize(std::min(of_bars.size(), of_bars.find(" ps ")));
  return points + ":" + column(curve.error) + " with yerrorbars " + of_bars + " ps 0 notitle, " +
         plain;
}

std::string plot_command(const std::vector<std::string>& parts) {
  std::string text = "plot ";
  for (const std::string& part : parts) text += (&part == parts.data() ? "" : ", \\\n  ") + part;
  return parts.empty() ? "set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n" : text + "\n";
}

std::string label_command(const std::string& axis, const std::string& text) {
  return text.empty() ? "unset " + axis + "label\n"
                      : "set " + axis + "label " + gnuplot_text(text) + " noenhanced\n";
}

std::string written_in_panel(const std::string& text) {
  const std::string label = "label 1";
  if (text.empty()) return "unset " + label + "\n";
  return "set " + label + " " + gnuplot_text(text) + " at graph 0.5,0.5 center noenhanced\n";
}

double tic_step(double span, double most) {
  const double least = span / most, power = std::pow(10.0, std::floor(std::log10(least)));
  return least <= power         ? power
         : least <= 2.0 * power ? 2.0 * power
         : least <= 5.0 * power ? 5.0 * power
                                : 10.0 * power;
}

/// Tics, few enough for a narrow panel from 0 to `end`.
std::string step_tics_command(const std::string& axis, double end) {
  return "set " + axis + "tics " + cell(tic_step(end, 4.0)) + "\n";
}

std::set<BinsAcross> bins_across(const std::vector<GroupWithCurves>& groups) {
  std::set<BinsAcross> bins;
  for (const GroupWithCurves& group : groups) {
    const Box& box = group->job.box;
    bins.insert(box.is_tube                   ? BinsAcross::rings
                : box.y == Boundary::periodic ? BinsAcross::slices_without_walls
                                              : BinsAcross::slices_between_walls);
  }
  return bins;
}

std::string bins_text(const std::set<BinsAcross>& bins) {
  std::string text;
  for (const BinsAcross one : bins) {
    text += text.empty() ? "" : " or ";
    switch (one) {
      case BinsAcross::slices_between_walls:
        text += "slices parallel to the walls";
        break;
      case BinsAcross::rings:
        text += "rings about the axis";
        break;
      case BinsAcross::slices_without_walls:
        text += "slices across y, where there is no wall";
        break;
    }
  }
  return text;
}

std::string panels_across(const Panels& panels, std::size_t k, const std::string& title,
                          const Group& group, const std::string& solid,
                          const std::string& touching) {
  const Box& box = group.job.box;
  const double end = box.is_tube ? box.width / 2.0 : box.width;
  return panels.place(k, 0) + range_command("x", {0.0, end}) + step_tics_command("x", end) +
         "set format x ''\n" + label_command("x", "") +
         label_command("y", k == 0 ? "solid fraction φ" : "") + "set title " + gnuplot_text(title) +
         " offset 0,-0.7 font ',11' noenhanced\n" + solid + "unset title\n" + panels.place(k, 1) +
         "set format x\n" +
         label_command("x", box.is_tube                   ? "distance from the wall / d"
                            : box.y == Boundary::periodic ? "y / d"
                                                          : "y / d, from wall to wall") +
         label_command("y", k == 0 ? "coordination number Z" : "") + touching +
         "set xtics autofreq\n";
}

std::string few_tics_command(const std::string& axis, double extreme) {
  if (!(extreme > 0.0)) return "";
  const double power = std::pow(10.0, std::floor(std::log10(extreme)));
  const double tic = extreme >= 5.0 * power   ? 5.0 * power
                     : extreme >= 2.0 * power ? 2.0 * power
                                              : power;
  const std::string at = cell(tic), end = cell(1.1 * extreme);
  return "set " + axis + "range [-" + end + ":" + end + "]\nset " + axis + "tics (-" + at +
         ", 0, " + at + ")\n";
}

std::string decade_tics_command(const std::string& axis, double low, double high) {
  std::string tics;
  for (int power = -4; power < 8; ++power) {
    for (int digit = 1; digit < 10; ++digit) {
      const double at = digit * std::pow(10.0, power);
      if (at < low || at > high) continue;
      const bool has_label = digit == 1 || digit == 2 || digit == 5;
      tics += (tics.empty() ? "" : ", ") + (has_label ? cell(at) : "'' " + cell(at) + " 1");
    }
  }
  return tics.empty() ? "" : "set " + axis + "tics (" + tics + ")\n";
}

Bars bars_of(const Axes& axes, Quantity quantity) {
  Bars bars;
  for (const Group* group : groups_on(axes)) {
    const Spread& spread = spread_of(*group, quantity);
    bars.push_back({spread.mean, spread.error});
  }
  return bars;
}

std::vector<double> shown_ends(const Bars& bars) {
  const double longest = longest_shown(bars);
  std::vector<double> ends;
  for (const Bar& bar : bars) {
    const double reach = has_error(bar) ? std::min(bar.error, longest) : 0.0;
    ends.insert(ends.end(), {bar.value - reach, bar.value + reach});
  }
  return ends;
}

std::string bars_text(const std::vector<Bars>& panels, const std::string& of) {
  bool have_errors = false, are_cut = false;
  for (const Bars& bars : panels) {
    const double longest = longest_shown(bars);
    for (const Bar& bar : bars) {
      have_errors = have_errors || has_error(bar);
      are_cut = are_cut || (has_error(bar) && bar.error > longest);
    }
  }
  if (!have_errors) return "";
  return "; bars" + of + " are standard errors" +
         (are_cut ? ", the longest of them cut at the frame" : "");
}

Range range_of(std::vector<double> values, double room) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double span = *high > *low ? *high - *low : std::max(std::abs(*low), 1.0);
  return {*low - room * span, *high + room * span};
}

Range within(const Range& range, double least, double most) {
  return {std::max(range.low, least), std::min(range.high, most)};
}

std::string range_command(const std::string& axis, const Range& range) {
  return "set " + axis + "range [" + cell(range.low) + ":" + cell(range.high) + "]\n";
}

}  // namespace grainsweep
