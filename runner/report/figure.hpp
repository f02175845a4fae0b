// A figure: the numbers it shows, as CSV, and the commands by which gnuplot draws them.
//
// Colours are those of Okabe and Ito, then of Tol, which people with any colour vision tell apart;
// series differ in the shape of their points, too. Text of users stands in single quotes, where
// gnuplot neither runs nor expands anything.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runner/report/fonts.hpp"

namespace grainsweep {

struct Figure {
  std::string name;     ///< of its files: "wall-effect"
  std::string title;    ///< for people
  std::string caption;  ///< what is shown and how to read it, plain text
  /// Name of a file and its content, a table with a header.
  std::vector<std::pair<std::string, std::string>> tables = {};
  std::string commands = {};   ///< from `set multiplot` on, without terminal and output
  int width = 960;             ///< px, of the SVG
  int height = 420;            ///< px, with a key of two lines
  std::string not_drawn = {};  ///< why there is nothing to see; empty if there is
};

/// The figure with the reason why it is not drawn.
Figure undrawn(Figure figure, std::string reason);

/// So many series are told apart in one figure.
inline constexpr std::size_t most_series = 12;

/// What gnuplot calls the mark (`pt`) of series k; after the last the first comes again.
int mark_of(std::size_t k);

/// Gives series k its mark and the colour of series `as`: "set style line 1 ...", counted from 1.
std::string series_style(std::size_t k, std::size_t as);

/// A string as gnuplot takes it, without line breaks.
std::string gnuplot_text(const std::string& text);

/// The same for the label of a tic, which gnuplot takes for a format: "20 %" would lose its sign.
std::string quoted_tic(const std::string& text);

/// Room beside and between panels, px.
struct PanelGaps {
  double right = 62.0;  ///< of each panel
  double row = 18.0;    ///< between rows of panels
  double above = 8.0;   ///< between the key and the first row
};

/// Characters that an entry of a key has room for, with two entries side by side.
inline constexpr std::size_t longest_entry = 42;

/// What a style stands for.
struct KeyEntry {
  std::string style;  ///< "points ls 1"
  std::string title;
};

/// Part of a figure: panels side by side and above each other, below a strip with the key.
class Panels {
 public:
  /// `heights`: share of each row of panels. The figure's height grows with the key.
  Panels(Figure& figure, std::size_t columns, std::vector<double> heights,
         std::vector<KeyEntry> key, PanelGaps gaps = {});

  /// Places the panel in this column and row, counted from 0 and from above.
  std::string place(std::size_t column, std::size_t row) const;

  /// The key, above all panels: a plot of its own. Panels have none then.
  std::string key() const;

  /// Characters that a title above a panel has room for.
  std::size_t title_length() const;

 private:
  double width_, height_;  ///< px
  std::size_t columns_;
  std::vector<double> heights_;  ///< shares
  std::vector<KeyEntry> key_;
  std::size_t key_columns_;
  double top_;  ///< px for the key
  PanelGaps gaps_;
};

/// What stands before all figures: colours, shapes, frame, how tables are read.
std::string figure_style();

/// The commands that draw the figure into NAME.svg, and into NAME.png as far as `in_png` has the
/// characters.
std::string drawing_commands(const Figure& figure, const Characters& in_png);

}  // namespace grainsweep
