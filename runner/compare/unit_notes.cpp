#include "runner/compare/unit_notes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "runner/compare/formula.hpp"
#include "runner/tables/csv.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {
namespace {

/// All published values, those of all families first.
std::vector<const Published*> values_of(const Reference& reference) {
  std::vector<const Published*> values;
  for (const Published& value : reference.common) values.push_back(&value);
  for (const PublishedFamily& family : reference.families) {
    for (const Published& value : family.values) values.push_back(&value);
  }
  return values;
}

/// Whether packings of these families have a width from `from` to `to`, but for rounding.
bool has_width(const std::vector<Family>& families, double from, double to) {
  constexpr double rounding = 1e-9;
  const auto is_there = [=](const Group& group) {
    const double width = group.job.box.width;
    return width >= from * (1.0 - rounding) && width <= to * (1.0 + rounding);
  };
  return std::any_of(families.begin(), families.end(), [&](const Family& family) {
    return std::any_of(family.walled.begin(), family.walled.end(), is_there);
  });
}

/// "30 mm is 5 d"
std::string in_d_text(double length, const Units& units) {
  return cell(length) + " " + printed_unit(units) + " is " + short_cell(length / units.d) + " d";
}

std::string note_on_width(double width, const std::vector<Family>& families, const Units& units) {
  const double in_d = width / units.d;
  if (!(width > 0.0) || has_width(families, width, width) || !has_width(families, in_d, in_d)) {
    return "";
  }
  return "note: no packing has the width " + cell(width) + " d; widths are in d, and " +
         in_d_text(width, units) + "\n";
}

/// Of a formula over the diameter of tubes tubes are asked, of one over the gap boxes.
std::string note_on_range(const PublishedFormula& formula, std::vector<Family> families,
                          const Units& units) {
  const double from = formula.from, to = formula.to;
  const std::string symbol = symbol_of_formula(formula.text);
  std::erase_if(families,
                [&](const Family& family) { return extent_symbol(family.walled) != symbol; });
  if (has_width(families, from, to) || !has_width(families, from / units.d, to / units.d)) {
    return "";
  }
  const std::string range = std::isfinite(to) ? "from " + cell(from) + " to " + cell(to) + " d"
                                              : "of " + cell(from) + " d or more";
  return "note: no packing has a " + symbol + " " + range + ", where " + formula.name +
         " holds; widths are in d, and " + in_d_text(from > 0.0 ? from : to, units) + "\n";
}

std::string note_on_points(const Published& published, const Units& units) {
  double farthest = 0.0;
  for (const PublishedProfile::Point& point : published.profile->points) {
    farthest = std::max(farthest, point.distance);
  }
  const double middle = published.width / 2.0;
  if (farthest <= middle || farthest / units.d > middle) return "";
  return "note: points of the profile of " + published.quantity + " at a width of " +
         cell(published.width) + " d lie up to " + cell(farthest) +
         " d from the wall, its middle " + cell(middle) + " d; distances are in d, and " +
         in_d_text(farthest, units) + "\n";
}

}  // namespace

std::string notes_on_lengths(const Reference& reference, const std::vector<Family>& families,
                             const Units& units) {
  std::set<double> widths;
  std::set<std::string> said;
  std::string notes;
  const auto add = [&](const std::string& note) {
    if (said.insert(note).second) notes += note;
  };
  const std::vector<const Published*> values = values_of(reference);
  for (const Published* value : values) widths.insert(value->width);
  for (const double width : widths) add(note_on_width(width, families, units));
  for (const Published* value : values) {
    if (value->formula) add(note_on_range(*value->formula, families, units));
    if (value->profile) add(note_on_points(*value, units));
  }
  return notes;
}

}  // namespace grainsweep
