#include "runner/compare/reference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/compare/formula.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/values.hpp"
#include "runner/tables/csv.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Whether `value` is an object; otherwise a problem is noted.
bool is_object(const Json& value, const std::string& pointer, Diagnostics& diagnostics) {
  if (value.is_object()) return true;
  diagnostics.push_back({pointer, "must be an object, is " + describe(value)});
  return false;
}

/// A member of `object`, a number no less than 0; nothing, and a problem noted, if it is anything
/// else.
std::optional<double> read_number(const Json& object, const char* key, const std::string& pointer,
                                  Diagnostics& diagnostics) {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  const bool is_number = found->is_number();
  if (is_number && found->get<double>() >= 0.0) return found->get<double>();
  diagnostics.push_back(
      {child_pointer(pointer, key),
       (is_number ? "must not be negative, is " : "must be a number, is ") + describe(*found)});
  return std::nullopt;
}

/// Without breaks of lines, which tables of figures cannot hold, and what a terminal would obey.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; }, ' ');
  return without_controls(text);
}

/// A member of `object`, a text; `otherwise` if there is none.
std::string read_text(const Json& object, const char* key, const std::string& pointer,
                      const std::string& otherwise, Diagnostics& diagnostics) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  if (found->is_string()) return on_one_line(*found);
  diagnostics.push_back({child_pointer(pointer, key), "must be a text, is " + describe(*found)});
  return otherwise;
}

PublishedError read_error(const Json& from, const std::string& pointer, Diagnostics& diagnostics) {
  const auto own = read_number(from, "error", pointer, diagnostics);
  const auto relative = read_number(from, "relative_error", pointer, diagnostics);
  if (own && relative) {
    diagnostics.push_back({child_pointer(pointer, "relative_error"),
                           "\"error\" is given, too; keep one of them", Anchor::key});
  }
  if (relative && *relative >= 1.0) {
    diagnostics.push_back({child_pointer(pointer, "relative_error"),
                           "must be a share of the value, below 1 (0.05 for 5 %), is " +
                               describe(from["relative_error"])});
  }
  return {own.value_or(0.0), relative.value_or(0.0)};
}

std::optional<Published::Range> read_range(const Json& value, const PublishedError& error,
                                           const std::string& pointer, Diagnostics& diagnostics) {
  const auto is_number = [](const Json& one) { return one.is_number(); };
  const bool is_range = value.is_array() && value.size() == 2;
  if (!(is_range ? std::all_of(value.begin(), value.end(), is_number) : value.is_number())) {
    diagnostics.push_back(
        {pointer, "must be a number or a range [low, high], is " +
                      (value.is_array() ? shortened(value.dump()) : describe(value))});
    return std::nullopt;
  }
  Published::Range range{is_range ? value[0] : value, is_range ? value[1] : value, 0.0};
  range.error = without_noise(error.of((range.low + range.high) / 2.0));
  if (range.low <= range.high) return range;
  diagnostics.push_back({pointer, "a range must be [low, high], is " + value.dump()});
  return std::nullopt;
}

/// " ± 0.01", " ± 5 %", or nothing.
std::string text_of(const PublishedError& error) {
  if (error.own > 0.0) return " ± " + cell(error.own);
  return error.relative > 0.0 ? " ± " + short_cell(100.0 * error.relative) + " %" : "";
}

/// "Mueller: 40 points from 0.05 to 3.5 d", or the formula in their place.
std::string text_of(const PublishedProfile& profile) {
  const std::string name = profile.name.empty() ? "" : profile.name + ": ";
  if (!profile.formula.empty()) return name + profile.formula + text_of(profile.error);
  return name + counted(profile.points.size(), "point") + " from " +
         cell(profile.points.front().distance) + " to " + cell(profile.points.back().distance) +
         " d" + text_of(profile.error);
}

std::string text_of(const Published& published) {
  if (published.profile) return text_of(*published.profile);
  if (published.formula) {
    const PublishedFormula& formula = *published.formula;
    return (formula.name == formula.text ? "" : formula.name + ": ") + formula.text +
           text_of(formula.error);
  }
  const auto& range = published.range;
  if (!range) return "-";
  if (range->low < range->high) return cell(range->low) + " to " + cell(range->high);
  return cell(range->low) + (range->error > 0.0 ? " ± " + cell(range->error) : "");
}

/// Where it holds, and what else cannot be said of it.
void read_extents(const Json& from, const std::string& pointer, PublishedFormula& formula,
                  Diagnostics& diagnostics) {
  for (const char* other : {"value", "width"}) {
    if (!from.contains(other)) continue;
    diagnostics.push_back({child_pointer(pointer, other),
                           "a formula gives the value at every width; leave this out, or the "
                           "formula",
                           Anchor::key});
  }
  formula.from = read_number(from, "from", pointer, diagnostics).value_or(formula.from);
  formula.to = read_number(from, "to", pointer, diagnostics).value_or(formula.to);
  if (formula.from <= formula.to) return;
  diagnostics.push_back(
      {child_pointer(pointer, "from"), "must not be above \"to\", is " + describe(from["from"])});
}

/// Nothing if there is none, or a wrong one.
std::optional<PublishedFormula> read_formula(const Json& from, const std::string& pointer,
                                             Diagnostics& diagnostics) {
  if (!from.contains("formula")) {
    for (const char* end : {"from", "to"}) {
      if (!from.contains(end)) continue;
      diagnostics.push_back({child_pointer(pointer, end),
                             "belongs to a \"formula\", and there is none", Anchor::key});
    }
    return std::nullopt;
  }
  PublishedFormula formula;
  formula.text = read_text(from, "formula", pointer, "", diagnostics);
  read_extents(from, pointer, formula, diagnostics);
  if (!from["formula"].is_string()) return std::nullopt;
  const std::string fault = fault_of_formula(formula.text);
  if (fault.empty()) return formula;
  diagnostics.push_back({child_pointer(pointer, "formula"), fault});
  return std::nullopt;
}

/// Notes a value that the quantity cannot have.
void note_impossible(const std::string& text, const std::string& pointer,
                     Diagnostics& diagnostics) {
  diagnostics.push_back(
      {pointer, "a share of the volume lies in [0, 1]; divide percentages by 100, is " + text});
}

/// The points of a list. Notes the first that is none.
void read_points(const Json& list, const std::string& quantity, const std::string& pointer,
                 PublishedProfile& profile, Diagnostics& diagnostics) {
  const auto is_point = [](const Json& one) {
    return one.is_array() && one.size() == 2 && one[0].is_number() && one[1].is_number() &&
           one[0].get<double>() >= 0.0;
  };
  for (const Json& one : list) {
    const std::string at = child_pointer(pointer, std::to_string(profile.points.size()));
    if (!is_point(one)) {
      diagnostics.push_back({at, "must be a point [distance from the wall in d, value], is " +
                                     (one.is_array() ? shortened(one.dump()) : describe(one))});
      return;
    }
    if (!is_possible(quantity, one[1])) return note_impossible(one[1].dump(), at, diagnostics);
    profile.points.push_back({one[0], one[1]});
  }
  std::stable_sort(profile.points.begin(), profile.points.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
}

/// Nothing if there is none, or a wrong one.
std::optional<PublishedProfile> read_profile(const Json& from, const std::string& quantity,
                                             const std::string& pointer, Diagnostics& diagnostics) {
  const auto found = from.find("profile");
  if (found == from.end()) return std::nullopt;
  const std::string place = child_pointer(pointer, "profile");
  for (const char* other : {"value", "formula"}) {
    if (!from.contains(other)) continue;
    diagnostics.push_back(
        {child_pointer(pointer, other), "a profile is given, too; keep one of them", Anchor::key});
  }
  PublishedProfile profile;
  if (found->is_string()) {
    profile.formula = on_one_line(*found);
    const std::string fault = fault_of_formula(profile.formula, FormulaOf::distance);
    if (fault.empty()) return profile;
    diagnostics.push_back({place, fault});
  } else if (found->is_array() && !found->empty()) {
    read_points(*found, quantity, place, profile, diagnostics);
  } else {
    diagnostics.push_back({place,
                           "must be a list of points [distance from the wall in d, value], or a "
                           "formula over y, that distance, is " +
                               describe(*found)});
  }
  return profile.points.empty() ? std::nullopt : std::optional(profile);
}

/// Notes why there can be no such quantity at the width, or no curve of it.
void check_quantity(const Json& from, const Published& published, const std::string& pointer,
                    Diagnostics& diagnostics) {
  constexpr double any_width = 1.0;
  const std::string& quantity = published.quantity;
  const bool is_formula = from.contains("formula");
  const bool is_profile_formula = from.contains("profile") && from["profile"].is_string();
  const bool has_any_width = is_formula || (is_profile_formula && !from.contains("width"));
  std::string fault = fault_of_quantity(quantity, has_any_width ? any_width : published.width);
  if (is_formula && is_of_family(quantity)) {
    fault = quantity + " is one value of a family, not one of each width: give a value";
  }
  if (fault.empty() && from.contains("profile") && !is_mean_of_width(quantity)) {
    fault = "profiles are of phi, porosity or Z, is " + quantity;
  }
  if (!fault.empty()) diagnostics.push_back({child_pointer(pointer, "quantity"), fault});
}

Published read_published(const Json& from, const std::string& pointer, Diagnostics& diagnostics) {
  Published published;
  if (!is_object(from, pointer, diagnostics)) return published;
  refuse_unknown_keys(from, pointer,
                      {"quantity", "width", "value", "formula", "from", "to", "profile", "error",
                       "relative_error", "text", "definition"},
                      diagnostics);
  published.quantity = read_text(from, "quantity", pointer, "", diagnostics);
  published.definition = read_text(from, "definition", pointer, "", diagnostics);
  published.formula = read_formula(from, pointer, diagnostics);
  const auto width = read_number(from, "width", pointer, diagnostics);
  const PublishedError error = read_error(from, pointer, diagnostics);
  published.width = width.value_or(0.0);
  published.profile = read_profile(from, published.quantity, pointer, diagnostics);
  if (!from.contains("quantity")) {
    diagnostics.push_back({pointer, "needs \"quantity\", its name"});
  } else if (from["quantity"].is_string() && from.contains("width") == width.has_value()) {
    check_quantity(from, published, pointer, diagnostics);
  }
  if (from.contains("value")) {
    published.range =
        read_range(from["value"], error, child_pointer(pointer, "value"), diagnostics);
  }
  const auto& range = published.range;
  if (range && !(is_possible(published.quantity, range->low) &&
                 is_possible(published.quantity, range->high))) {
    note_impossible(text_of(published), child_pointer(pointer, "value"), diagnostics);
  }
  if (published.profile) {
    published.profile->error = error;
    published.profile->name = read_text(from, "text", pointer, "", diagnostics);
    published.text = text_of(published);
  } else if (published.formula) {
    PublishedFormula& formula = *published.formula;
    formula.error = error;
    formula.name = read_text(from, "text", pointer, formula.text, diagnostics);
    if (formula.name.empty()) formula.name = formula.text;
    published.text = text_of(published);
  } else {
    published.text = read_text(from, "text", pointer, text_of(published), diagnostics);
  }
  return published;
}

/// `read` of each element of the list under `key`.
template <typename Read>
auto read_list(const Json& object, const char* key, const std::string& pointer,
               Diagnostics& diagnostics, const Read& read) {
  std::vector<decltype(read(object, pointer, diagnostics))> elements;
  const auto found = object.find(key);
  if (found == object.end()) return elements;
  const std::string place = child_pointer(pointer, key);
  if (!found->is_array()) {
    diagnostics.push_back({place, "must be a list, is " + describe(*found)});
    return elements;
  }
  for (const Json& element : *found) {
    elements.push_back(
        read(element, child_pointer(place, std::to_string(elements.size())), diagnostics));
  }
  return elements;
}

PublishedFamily read_family(const Json& from, const std::string& pointer,
                            Diagnostics& diagnostics) {
  PublishedFamily family;
  if (!is_object(from, pointer, diagnostics)) return family;
  refuse_unknown_keys(from, pointer, {"where", "values"}, diagnostics);
  family.values = read_list(from, "values", pointer, diagnostics, read_published);
  if (!from.contains("where") || !from["where"].is_object()) {
    diagnostics.push_back(
        {pointer, "needs \"where\", an object with what the parameters of the family are"});
    return family;
  }
  family.where = read_where(from["where"], child_pointer(pointer, "where"), diagnostics);
  return family;
}

Reference reference_of(const Json& from, Diagnostics& diagnostics) {
  Reference reference;
  if (!is_object(from, "", diagnostics)) return reference;
  refuse_unknown_keys(from, "", {"source", "families", "common"}, diagnostics);
  if (!from.contains("source")) {
    diagnostics.push_back({"", "needs \"source\", where the values are from"});
  }
  if (!from.contains("families") && !from.contains("common")) {
    diagnostics.push_back({"", "needs \"families\" or \"common\", lists of published values"});
  }
  reference.source = read_text(from, "source", "", "", diagnostics);
  reference.families = read_list(from, "families", "", diagnostics, read_family);
  reference.common = read_list(from, "common", "", diagnostics, read_published);
  for (std::size_t k = 0; k < reference.common.size(); ++k) {
    const Published& one = reference.common[k];
    if (!one.formula && !one.profile) continue;
    const std::string kind = one.formula ? "formula" : "profile";
    diagnostics.push_back({"/common/" + std::to_string(k) + "/" + kind,
                           kind + "s belong to \"families\"; { } as \"where\" means all of them",
                           Anchor::key});
  }
  return reference;
}

}  // namespace

Reference read_reference(const std::string& path) {
  const std::string text = read_file(path);
  JsonReading json = parse_strictly(text, path);
  Diagnostics diagnostics = std::move(json.errors);
  Reference reference;
  if (diagnostics.empty()) {
    reference = reference_of(json.value, diagnostics);
    locate(json, text, path, diagnostics);
  }
  if (diagnostics.empty()) return reference;
  std::string told;
  for (const Diagnostic& diagnostic : diagnostics) {
    told += (told.empty() ? "" : "\n") + to_string(diagnostic);
  }
  throw BadInput(told);
}

std::vector<PublishedProfile::Point> points_at(double width, const Published& published) {
  const PublishedProfile& profile = *published.profile;
  if (profile.formula.empty()) return profile.points;
  constexpr double step = 0.05;    // d; half of a usual bin
  constexpr double most = 2000.0;  // of a gap of 200 d
  std::vector<PublishedProfile::Point> points;
  const double last = std::min(std::floor(width / 2.0 / step), most);
  for (double k = 1.0; k <= last; ++k) {
    const double value = value_of_formula(profile.formula, width, k * step);
    if (is_possible(published.quantity, value)) {
      points.push_back({without_noise(k * step), value});
    }
  }
  return points;
}

std::string reference_beside(const std::string& sweep_file) {
  const std::string ending = ".json";
  const bool has_ending = sweep_file.ends_with(ending);
  return sweep_file.substr(0, sweep_file.size() - (has_ending ? ending.size() : 0)) +
         ".reference.json";
}

std::string kept_reference(const std::string& folder) { return folder + "/reference.json"; }

}  // namespace grainsweep
