// Kinds of contact, and what others have published.
#include <algorithm>
#include <array>
#include <cmath>

#include "runner/report/figures.hpp"
#include "runner/report/plots.hpp"
#include "runner/sweep/text_lines.hpp"

namespace grainsweep {
namespace {

constexpr std::array kind_names = {"simple", "double", "triple"};

std::string kinds_csv(const Axes& axes) {
  std::vector<std::string> header = {"series", "group", "x"};
  for (const char* of : {"contacts_", "force_"}) {
    for (const char* kind : kind_names) {
      header.push_back(std::string(of) + kind);
      header.push_back(header.back() + "_error");
    }
  }
  header.emplace_back("name");
  std::string text = csv_line(header);
  for (const Series& series : axes.series) {
    const std::string number = series_cell(axes, series);
    for (const Group* group : series.groups) {
      std::vector<std::string> cells = {number, cell(group->number), cell(abscissa(axes, *group))};
      for (std::size_t column = 3; column + 1 < header.size(); column += 2) {
        const Spread& mean = mean_of(*group, header[column]);
        cells.insert(cells.end(), {cell(mean.mean), cell(mean.error)});
      }
      cells.push_back(cell(series.name));
      text += csv_line(cells);
    }
  }
  return text;
}

std::string kinds_panel(const std::string& of, std::size_t series) {
  std::vector<std::string> parts;
  for (std::size_t s = 0; s < series; ++s) {
    for (std::size_t k = 0; k < kind_names.size(); ++k) {
      const std::string column = of + kind_names[k], style = "points ls " + cell(k + 1);
      parts.push_back(plot_part({"contacts.csv", "series", s + 1, "x", column, column + "_error",
                                 series == 1 ? style : style + " pt " + cell(mark_of(s))}));
    }
  }
  return plot_command(parts);
}

/// Colours tell the kinds apart, and marks tell the series apart if there are several.
std::vector<KeyEntry> kinds_key(const Axes& axes) {
  const std::vector<const Series*> shown = shown_series(axes);
  const bool is_one = shown.size() == 1;
  std::vector<KeyEntry> key;
  for (const char* kind : {"at a point", "along a line", "over an area"}) {
    const std::string line = " ls " + cell(key.size() + 1);
    key.push_back({is_one ? "points" + line : "lines" + line + " lw 5", kind});
  }
  for (std::size_t s = 0; !is_one && s < shown.size(); ++s) {
    key.push_back({"points lc rgb '#444444' pt " + cell(mark_of(s)), shown[s]->name});
  }
  return key;
}

std::vector<double> places_of(const Axes& axes) {
  std::vector<double> places;
  for (const Group* group : groups_on(axes)) places.push_back(abscissa(axes, *group));
  return places;
}

Bars shares_of(const Axes& axes, const std::string& of) {
  Bars bars;
  for (const Group* group : groups_on(axes)) {
    for (const char* kind : kind_names) {
      const Spread& share = mean_of(*group, of + kind);
      bars.push_back({share.mean, share.error});
    }
  }
  return bars;
}

/// From 0 to the end of the highest error bar of these shares, with some room above.
Range shares_shown(const Axes& axes, const std::string& of) {
  double highest = 0.0;
  for (const double end : shown_ends(shares_of(axes, of))) highest = std::max(highest, end);
  return {0.0, range_of({0.0, highest}, 0.05).high};
}

/// The groups whose contacts have kinds, those of polyhedra that press on each other; series
/// without any are left out.
Axes of_kinds(Axes axes) {
  for (Series& series : axes.series) {
    std::erase_if(series.groups, [](const Group* group) {
      return !std::isfinite(mean_of(*group, "contacts_simple").mean);
    });
  }
  std::erase_if(axes.series, [](const Series& series) { return series.groups.empty(); });
  return axes;
}

/// Those with a difference that is known in standard errors.
std::vector<const Comparison*> measured_of(const std::vector<Comparison>& comparisons) {
  std::vector<const Comparison*> measured;
  for (const Comparison& one : comparisons) {
    const auto errors = difference_in_errors(one);
    if (errors && std::isfinite(*errors)) measured.push_back(&one);
  }
  return measured;
}

/// Wide enough for all of them and for the band in which both sides agree.
Range shown_errors(const std::vector<const Comparison*>& measured) {
  constexpr double room = 1.3;  // a factor, for far from 0 the scale may be logarithmic
  Range shown{-1.5 * agreement_limit, 1.5 * agreement_limit};
  for (const Comparison* one : measured) {
    const double errors = *difference_in_errors(*one);
    shown.low = std::min(shown.low, room * errors);
    shown.high = std::max(shown.high, room * errors);
  }
  return shown;
}

/// Whether no value lies so far off that it would press those that agree into a line of the axis.
bool is_linear(const Range& shown) {
  constexpr double most = 20.0;  // errors to either side
  return std::max(-shown.low, shown.high) <= most;
}

/// 0, and 1, 3, 10, 30 ... to both sides.
std::string tics_of_errors(const Range& shown) {
  std::string tics = "0";
  for (double power = 1.0; power < std::max(-shown.low, shown.high); power *= 10.0) {
    for (const double at : {power, 3.0 * power}) {
      if (at < shown.high) tics += ", " + cell(at);
      if (-at > shown.low) tics += ", " + cell(-at);
    }
  }
  return tics;
}

}  // namespace

Figure contacts_figure(const Axes& axes) {
  const Axes all = of_kinds(axes), drawn = thinned(all, most_points / (2 * kind_names.size()));
  Figure figure{.name = "contacts",
                .title = "Kinds of contact",
                .caption =
                    "Shares of the force-bearing contacts between polyhedra, and of the "
                    "force that they carry"};
  figure.caption += bars_text({shares_of(drawn, "contacts_"), shares_of(drawn, "force_")}) + "." +
                    left_out_text(drawn, figure.name) + thinned_text(drawn, all);
  figure.tables = {{"contacts.csv", kinds_csv(drawn)}};
  if (shown_series(axes).empty()) return undrawn(std::move(figure), "no packing has settled");
  if (drawn.series.empty()) return undrawn(std::move(figure), "no grains press on each other");
  const Panels panels(figure, 2, {1.0}, kinds_key(drawn), {.right = 24.0});
  const std::size_t series = shown_series(drawn).size();
  const std::string x = range_command("x", range_of(places_of(drawn), 0.06)) +
                        label_command("x", abscissa_title(drawn));
  figure.commands = "set multiplot\n" + panels.key() + panels.place(0, 0) + x +
                    range_command("y", shares_shown(drawn, "contacts_")) +
                    label_command("y", "share of contacts") + kinds_panel("contacts_", series) +
                    panels.place(1, 0) + x + range_command("y", shares_shown(drawn, "force_")) +
                    label_command("y", "share of force") + kinds_panel("force_", series);
  return figure;
}

Figure published_figure(const std::vector<Comparison>& comparisons) {
  constexpr std::size_t most_characters = 64;
  constexpr double character = 7.2;  // px, of tics of 13 px, on the mean
  Figure figure{.name = "published",
                .title = "Beside published values",
                .caption =
                    "Measured less published value, in standard errors of both. Within the shaded "
                    "band both agree, beyond it also where they differ by no more than the bound "
                    "of settling. The table below has values and definitions."};
  std::vector<const Comparison*> measured = measured_of(comparisons);
  if (measured.empty()) {
    return undrawn(std::move(figure),
                   "no published value can be set beside a measured one with an error");
  }
  constexpr std::size_t most_rows = 200;  // a picture of more than 32,000 px cannot be drawn
  if (measured.size() > most_rows) {
    figure.caption += " The first " + cell(most_rows) + " of " + cell(measured.size()) +
                      " are drawn; all are in the table.";
    measured.resize(most_rows);
  }
  std::string csv = csv_line({"all", "row", "errors", "quantity", "family"}), tics;
  std::vector<std::string> entries;
  entries.reserve(measured.size());
  for (const Comparison* one : measured) entries.push_back(one->family + ": " + one->title);
  entries = told_apart(entries, most_characters);
  std::size_t longest = 0;
  for (const std::string& entry : entries) longest = std::max(longest, characters(entry));
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const Comparison& one = *measured[k];
    csv += csv_line(
        {"1", cell(k + 1), cell(*difference_in_errors(one)), cell(one.title), cell(one.family)});
    tics += (k == 0 ? "" : ", ") + quoted_tic(entries[k]) + " " + cell(k + 1);
  }
  const auto rows = static_cast<int>(measured.size());
  const Range shown = shown_errors(measured);
  const std::string limit = cell(agreement_limit);
  figure.tables = {{"published.csv", csv}};
  figure.height = 120 + 24 * rows;
  const double left = 24.0 + character * static_cast<double>(longest);  // px
  figure.commands =
      "set multiplot\nset lmargin at screen " + cell(left / figure.width) +
      "\nset rmargin at screen 0.96\n"
      "unset key\nset yrange [" +
      cell(rows) + ".6:0.4]\nset ytics noenhanced (" + tics + ")\nset object 1 rectangle from -" +
      limit + ", graph 0 to " + limit + ", graph 1 fc rgb '#e8f1f8' fs solid noborder behind\n" +
      (is_linear(shown) ? "" : "set nonlinear x via asinh(x) inverse sinh(x)\n") +
      range_command("x", shown) +
      (is_linear(shown) ? "" : "set xtics (" + tics_of_errors(shown) + ")\n") +
      "set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb '#444444'\n" +
      label_command("x", std::string("measured less published, standard errors") +
                             (is_linear(shown) ? "" : " (logarithmic far from 0)")) +
      plot_command(
          {plot_part({"published.csv", "all", 1, "errors", "row", "", "points ls 1 ps 1"})});
  return figure;
}

}  // namespace grainsweep
