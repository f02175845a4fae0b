#include "runner/report/figure.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

#include "runner/report/axes.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

constexpr double left_margin = 106.0, bottom_margin = 66.0;  // px
const std::string frame =
    "set border 3 lw 1 lc rgb '#444444'\nset tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
    "set xtics nomirror\nset ytics nomirror\nset grid lc rgb '#dddddd' lw 0.6 dt solid\n";
constexpr int key_line = 20;  // px

/// Entries of the key that stand side by side: as many as gnuplot finds room for in 960 px.
std::size_t columns_of(const std::vector<KeyEntry>& key) {
  constexpr std::size_t longest_of_three = 24;
  const bool are_short = std::all_of(key.begin(), key.end(), [](const KeyEntry& entry) {
    return characters(entry.title) <= longest_of_three;
  });
  return are_short ? 3 : 2;
}

int lines_of(std::size_t entries, std::size_t columns) {
  return static_cast<int>((entries + columns - 1) / columns);
}

/// The height of a figure with a key of so many lines, px.
int height_with(int lines, int height) {
  constexpr int usual_lines = 2;
  return height + key_line * std::max(lines - usual_lines, 0);
}

/// "limestone 8/…, height = 0.5": an entry without room for it loses the end of its label, not of
/// its values. One without values, or whose values leave no room, stays as it is.
std::string with_short_label(const std::string& title) {
  constexpr std::size_t shortest_label = 6;
  const std::size_t label_end = title.find(", ");
  if (characters(title) <= longest_entry || label_end == std::string::npos) return title;
  const std::string label = title.substr(0, label_end), values = title.substr(label_end);
  const std::size_t taken = characters(values);
  const bool has_room = taken + shortest_label <= longest_entry;
  if (!has_room || values.find(" = ") == std::string::npos) return title;
  return shortened(label, longest_entry - taken) + values;
}

/// What stands in a key for these titles.
std::vector<std::string> entries_of(const std::vector<std::string>& titles) {
  std::vector<std::string> entries;
  entries.reserve(titles.size());
  for (const std::string& title : titles) entries.push_back(with_short_label(title));
  const auto differing = [](const std::vector<std::string>& texts) {
    return std::set<std::string>(texts.begin(), texts.end()).size();
  };
  return told_apart(differing(entries) == differing(titles) ? entries : titles, longest_entry);
}

}  // namespace

std::string gnuplot_text(const std::string& text) {
  std::string inside;
  for (const char c : text) {
    inside += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    if (c == '\'') inside += c;
  }
  return "'" + inside + "'";
}

std::string quoted_tic(const std::string& text) {
  std::string format;
  for (const char c : text) format += c == '%' ? "%%" : std::string(1, c);
  return gnuplot_text(format);
}

Panels::Panels(Figure& figure, std::size_t columns, std::vector<double> heights,
               std::vector<KeyEntry> key, PanelGaps gaps)
    : width_(figure.width),
      height_(height_with(lines_of(key.size(), columns_of(key)), figure.height)),
      columns_(columns),
      heights_(std::move(heights)),
      key_(std::move(key)),
      key_columns_(columns_of(key_)),
      top_(gaps.above + 12.0 + key_line * lines_of(key_.size(), key_columns_)),
      gaps_(gaps) {
  figure.height = static_cast<int>(height_);
}

std::string Panels::place(std::size_t column, std::size_t row) const {
  const double wide = width_ / static_cast<double>(columns_);
  const double gaps = gaps_.row * static_cast<double>(heights_.size() - 1);
  const double high = height_ - top_ - bottom_margin - gaps;
  const auto first = heights_.begin();
  const double above = std::accumulate(first, first + static_cast<std::ptrdiff_t>(row), 0.0);
  const double top = height_ - top_ - above * high - static_cast<double>(row) * gaps_.row;
  const double left = static_cast<double>(column) * wide;
  const auto margin = [](const char* side, double at) {
    return std::string("set ") + side + "margin at screen " + cell(at) + "\n";
  };
  return margin("l", (left + left_margin) / width_) +
         margin("r", (left + wide - gaps_.right) / width_) + margin("t", top / height_) +
         margin("b", (top - heights_[row] * high) / height_);
}

std::string Panels::key() const {
  std::string plots;
  std::vector<std::string> titles;
  for (const KeyEntry& entry : key_) titles.push_back(entry.title);
  titles = entries_of(titles);
  for (std::size_t k = 0; k < key_.size(); ++k) {
    plots +=
        (k == 0 ? "" : ", ") + ("NaN with " + key_[k].style + " title ") + gnuplot_text(titles[k]);
  }
  return "set lmargin at screen 0.02\nset rmargin at screen 0.98\nset tmargin at screen " +
         cell(1.0 - 6.0 / height_) + "\nset bmargin at screen " +
         cell(1.0 - (top_ - gaps_.above) / height_) +
         "\nset border 0\nunset tics\nunset grid\nset xrange [0:1]\nset yrange [0:1]\n" +
         "set key center top horizontal Left reverse noenhanced samplen 2 width 2 maxcols " +
         cell(key_columns_) + "\nplot " + plots + "\nset autoscale\nunset key\n" + frame;
}

std::size_t Panels::title_length() const {
  constexpr double character = 6.6;  // px, at most, of titles of 11 px
  const double room = width_ / static_cast<double>(columns_) - left_margin + gaps_.right;
  return static_cast<std::size_t>(room / character);
}

Figure undrawn(Figure figure, std::string reason) {
  figure.not_drawn = std::move(reason);
  return figure;
}

int mark_of(std::size_t k) {
  constexpr std::array<int, most_series> marks = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10, 1, 2};
  return marks[k % marks.size()];
}

std::string series_style(std::size_t k, std::size_t as) {
  constexpr std::array<const char*, most_series> colours = {
      "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9",
      "#000000", "#882255", "#999933", "#332288", "#44AA99", "#661100"};
  return "set style line " + cell(k + 1) + " lc rgb '" + colours[as % colours.size()] + "' pt " +
         cell(mark_of(k)) + " ps 0.75 lw 1.6\n";
}

std::string figure_style() {
  // A box of no width about points with bars makes gnuplot 5.4 fall back to one that it erases.
  std::string text =
      "set encoding utf8\nset datafile separator comma\nset datafile columnheaders\n"
      "set bars small\nset samples 400\nset pointintervalbox 0.0001\n"
      "set errorbars lw 1.2\n";
  for (std::size_t k = 0; k < most_series; ++k) text += series_style(k, k);
  return text + frame + "set style line 20 lc rgb '#777777' pt 7 ps 0.35 lw 1\n";
}

std::string drawing_commands(const Figure& figure, const Characters& in_png) {
  const std::string size = cell(figure.width) + "," + cell(figure.height);
  const std::string twice = cell(2 * figure.width) + "," + cell(2 * figure.height);
  const auto draw = [&](const std::string& terminal, const std::string& ending,
                        const std::string& commands) {
    return "reset session\n" + terminal + "\nset output " + gnuplot_text(figure.name + ending) +
           "\n" + figure_style() + commands + "unset multiplot\nunset output\n";
  };
  return draw("set terminal svg size " + size + " font 'sans-serif,13' background 'white' name " +
                  gnuplot_text(figure.name),
              ".svg", figure.commands) +
         draw("set terminal pngcairo size " + twice +
                  " font 'sans-serif,13' fontscale 1.5 linewidth 2 pointscale 2 background 'white'",
              ".png", drawable(figure.commands, in_png));
}

}  // namespace grainsweep
