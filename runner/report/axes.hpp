// What a sweep varies, as figures and tables need it: one parameter along the axis, a series of
// groups for each combination of the others.
#pragma once

#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// Groups that differ in nothing but the axis (and their labels), by ascending value on it.
struct Series {
  std::string name;              ///< its label, or what tells it from the others
  std::string distinction = {};  ///< of a name with both the second; else empty
  std::vector<const Group*> groups;
  /// Points of a random design instead: they share a label and differ in several numbers.
  bool is_scattered = false;
};

struct Axes {
  std::string parameter;  ///< dotted name of what is along the axis: box.width if it is varied
  std::string title;      ///< of the axis, with the unit
  std::vector<Series> series;
  std::vector<std::string> scattered = {};  ///< numbers that a random design varies; else none
  GivenUnits units = {};                    ///< of the sweep
  std::string folder = {};                  ///< as for GroupWithCurves
};

/// box.width goes along the axis wherever it is varied, with tubes at their diameter, or
/// tube.diameter; else the number that takes most values, of those that most groups have and that
/// varies by itself, under one label or in a random design; if there is none, the number of the
/// group. Where many groups would each be alone on the axis, like points of a random design, those
/// of one label form a series. Refers to the groups.
Axes axes_of(const std::vector<Group>& groups);

/// Where a group lies on the axis; NaN if it lacks what is along it.
double place_on(const Axes& axes, const Group& group);

/// The number that a varied parameter has in a group, for tubes their diameter as box.width; NaN if
/// it has none, or one that nothing depends on.
double value_of(const Group& group, const std::string& parameter);

/// What stands at an axis of this parameter.
std::string axis_title(const std::string& parameter);

/// Whether straight lines in 1 / W are fitted along this axis: that of a gap between walls, or of a
/// diameter.
bool is_over_width(const Axes& axes);

/// What is along such an axis: W, or D where all are tubes.
std::string width_symbol(const Axes& axes);

/// "walls, W = 5": what tells a group from all others of its sweep. A longer label is shortened to
/// `longest_label` characters.
std::string title_of(const Group& group, std::size_t longest_label = 1000);

/// Characters of a label that a figure has room for beside other words.
inline constexpr std::size_t figure_label = 16;

/// What tells these groups from all of a sweep, each in at most so many characters. Where there is
/// no room for all, what the sweep shares is left out, and numbers are short; then what all of a
/// label share; then labels. Where there is no room for that either, they are told from each other.
std::vector<std::string> titles_of(const std::vector<const Group*>& groups, std::size_t longest,
                                   const std::vector<const Group*>& sweep);

/// Texts shortened to so many characters; those that would then be alike are left out in the middle
/// instead, up to where they first differ, and if that does not tell them apart either they begin
/// with their number in the list.
std::vector<std::string> told_apart(const std::vector<std::string>& texts, std::size_t longest);

/// `text` shortened to so many characters, the last one "…" where any were left out.
std::string shortened(const std::string& text, std::size_t longest);

}  // namespace grainsweep
