// Parts that the commands of several figures are made of.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "runner/report/axes.hpp"
#include "runner/report/figure.hpp"
#include "runner/tables/fits.hpp"

namespace grainsweep {

/// At most `most` of these, evenly spread over all.
template <class T>
std::vector<T> evenly_spread(const std::vector<T>& all, std::size_t most) {
  std::vector<T> chosen;
  const std::size_t count = std::min(most, all.size());
  for (std::size_t k = 0; k < count; ++k) {
    chosen.push_back(all[count == 1 ? 0 : k * (all.size() - 1) / (count - 1)]);
  }
  return chosen;
}

/// A figure draws so many points: 100,000 make a page of 17 MB.
inline constexpr std::size_t most_points = 5000;

/// The groups of all series, one series after the other.
std::vector<const Group*> groups_on(const Axes& axes);

/// Where a group stands on the axis of a figure: d / W of a gap between walls, 0 without walls;
/// over anything else its place on the axis.
double abscissa(const Axes& axes, const Group& group);
std::string abscissa_title(const Axes& axes);

/// The series that a figure shows: the first most_series with a settled packing.
std::vector<const Series*> shown_series(const Axes& axes);

/// "12 of 40 series are shown, all are in NAME.csv"; empty if all are shown.
std::string left_out_text(const Axes& axes, const std::string& name);

/// Whether there are more series with a settled packing: they are grey and have no mark of their
/// own.
bool has_other_series(const Axes& axes);
inline constexpr const char* other_series_style = "points lc rgb '#bbbbbb' pt 7 ps 0.5";

/// "12 of 40 series have marks of their own, the others are grey"; empty if all have.
std::string grey_series_text(const Axes& axes);

/// The axes with about `most` of their groups with a settled packing, evenly spread over each
/// series; with all groups if no more of them have one.
Axes thinned(const Axes& axes, std::size_t most);

/// " 2500 of 9998 groups are shown."; empty if all of `axes` with a settled packing are `drawn`.
std::string thinned_text(const Axes& drawn, const Axes& axes);

/// Groups with a settled packing, at most `most` of them, evenly spread over all. Throws FileError.
std::vector<GroupWithCurves> chosen_groups(const Axes& axes, std::size_t most);

/// The same for groups between walls, if there are any: for those of these numbers, if there are
/// any.
std::vector<GroupWithCurves> chosen_walled_groups(const Axes& axes, std::size_t most,
                                                  const std::set<std::size_t>& numbers = {});

/// The same for mixtures.
std::vector<GroupWithCurves> chosen_mixtures(const Axes& axes, std::size_t most);

/// titles_of these groups of the axes.
std::vector<std::string> titles_of(const std::vector<GroupWithCurves>& groups, std::size_t longest,
                                   const Axes& axes);

/// " 6 of 120 groups are shown."; empty if all are.
std::string few_of_all_text(std::size_t shown, const Axes& axes);

/// The number of a series of the axes among those shown, from 1; empty if it is not.
std::string series_cell(const Axes& axes, const Series& series);

/// Gives packings without walls, whose series is of the same family as another, its colour.
std::string reference_colours(const Axes& axes);

/// A key entry for each of the shown series.
std::vector<KeyEntry> series_key(const Axes& axes, const std::string& style);

/// The same for points, with an entry for the others if there are any.
std::vector<KeyEntry> key_with_others(const Axes& axes);

/// One curve of a plot: `using` of the lines of a table whose column `selector` is `number`.
struct Curve2d {
  std::string table, selector;
  std::size_t number = 1;        ///< 0: those with no number there
  std::string x, y, error = {};  ///< columns; bars stand where there is an error
  std::string style;             ///< "points ls 1"
};
std::string plot_part(const Curve2d& curve);

/// "plot a, b, c"; an empty panel where there are none.
std::string plot_command(const std::vector<std::string>& parts);

/// "set xlabel '...'", or without a label.
std::string label_command(const std::string& axis, const std::string& text);

/// A text in the middle of the next panel, as of one that has nothing to show; none if it is "".
std::string written_in_panel(const std::string& text);

/// What the bins of profiles across packings are.
enum class BinsAcross { slices_between_walls, rings, slices_without_walls };
std::set<BinsAcross> bins_across(const std::vector<GroupWithCurves>& groups);

/// "slices parallel to the walls or rings about the axis".
std::string bins_text(const std::set<BinsAcross>& bins);

/// Two panels of column k, one above the other, of what the group does from wall to wall: `solid`
/// plots the solid fraction, `touching` the coordination number, `title` stands above.
std::string panels_across(const Panels& panels, std::size_t k, const std::string& title,
                          const Group& group, const std::string& solid,
                          const std::string& touching);

/// Tics at 0 and one to each side, for values that lie around 0, and their range.
std::string few_tics_command(const std::string& axis, double extreme);

/// Tics at each digit of the decades of a logarithmic axis, with labels at 1, 2 and 5.
std::string decade_tics_command(const std::string& axis, double low, double high);

struct Range {
  double low = 0.0, high = 1.0;
};

/// A value and the length of its error bar to each side; none where the error is not finite.
struct Bar {
  double value = 0.0, error = 0.0;
};
using Bars = std::vector<Bar>;

/// The means of all groups.
Bars bars_of(const Axes& axes, Quantity quantity);

/// The ends of the bars that an axis reaches to. A bar is cut at the farther of three median bars
/// and what the values span: one value that is hardly known does not press all others into a line.
std::vector<double> shown_ends(const Bars& bars);

/// What a caption says of bars, "; bars are standard errors", with `of` behind the word: those that
/// are cut, too; nothing where there is none.
std::string bars_text(const std::vector<Bars>& panels, const std::string& of = "");

/// The range of these values with some room at both ends, a share of it.
Range range_of(std::vector<double> values, double room);

/// The step, 1, 2 or 5 times a power of ten, that puts about `most` tics on an axis over `span`.
double tic_step(double span, double most);

/// The part of a range between two values beyond which nothing can be.
Range within(const Range& range, double least, double most);

/// "set xrange [0.1:0.3]"; with low above high the axis runs downwards.
std::string range_command(const std::string& axis, const Range& range);

}  // namespace grainsweep
