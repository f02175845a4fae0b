#include "runner/compare/reference.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/compare/formula.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/values.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

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

std::string text_of(const Published& published) {
  if (published.formula) {
    const PublishedFormula& formula = *published.formula;
    const std::string text =
        (formula.name == formula.text ? "" : formula.name + ": ") + formula.text;
    if (formula.error.own > 0.0) return text + " ± " + cell(formula.error.own);
    return text + (formula.error.relative > 0.0
                       ? " ± " + short_cell(100.0 * formula.error.relative) + " %"
                       : "");
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

Published read_published(const Json& from, const std::string& pointer, Diagnostics& diagnostics) {
  Published published;
  if (!is_object(from, pointer, diagnostics)) return published;
  refuse_unknown_keys(from, pointer,
                      {"quantity", "width", "value", "formula", "from", "to", "error",
                       "relative_error", "text", "definition"},
                      diagnostics);
  published.quantity = read_text(from, "quantity", pointer, "", diagnostics);
  published.definition = read_text(from, "definition", pointer, "", diagnostics);
  published.formula = read_formula(from, pointer, diagnostics);
  const bool is_formula = from.contains("formula");
  const auto width = read_number(from, "width", pointer, diagnostics);
  const PublishedError error = read_error(from, pointer, diagnostics);
  published.width = width.value_or(0.0);
  if (!from.contains("quantity")) {
    diagnostics.push_back({pointer, "needs \"quantity\", its name"});
  } else if (from["quantity"].is_string() && from.contains("width") == width.has_value()) {
    constexpr double any_width = 1.0;
    std::string fault =
        fault_of_quantity(published.quantity, is_formula ? any_width : published.width);
    if (is_formula && is_of_family(published.quantity)) {
      fault = published.quantity + " is one value of a family, not one of each width: give a value";
    }
    if (!fault.empty()) diagnostics.push_back({child_pointer(pointer, "quantity"), fault});
  }
  if (from.contains("value")) {
    published.range =
        read_range(from["value"], error, child_pointer(pointer, "value"), diagnostics);
  }
  const auto& range = published.range;
  if (range && is_share(published.quantity) && !(range->low >= 0.0 && range->high <= 1.0)) {
    diagnostics.push_back({child_pointer(pointer, "value"),
                           "a share of the volume lies in [0, 1]; divide percentages by 100, is " +
                               text_of(published)});
  }
  if (published.formula) {
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

/// A value as `describes` compares it: 0 and 0.0 are one.
std::string plain(const json& value) {
  return value.is_number() ? json(value.get<double>()).dump() : value.dump();
}

bool is_of_accuracy(const std::string& path) {
  return path == "accuracy" || path == "accuracy.preset";
}

/// What a family has at `path`, as `describes` compares it; an accuracy may have two names.
/// `known`: its parameters by their JSON pointers.
std::vector<std::string> values_at(const std::string& path, const Family& family,
                                   const json& known) {
  const JobFacts& job = first_group(family).job;
  if (path == "shape") return {plain(job.shape)};
  if (is_of_accuracy(path)) return {plain(job.accuracy), plain(job.settles_as)};
  std::string pointer = "/" + path;
  std::replace(pointer.begin(), pointer.end(), '.', '/');
  if (!known.contains(pointer)) return {};
  return {plain(known[pointer])};
}

/// Names that families are told apart by, as a parameter.
Parameter named(std::vector<std::string> names) {
  return {.path = "name", .meaning = "", .kind = ValueKind::choice, .choices = std::move(names)};
}

/// What families may be told apart by at `path`: a shape and an accuracy by their names, a number
/// in a list by its place, "gap_tolerances.0". Nothing if no packing has such a parameter.
std::optional<Parameter> distinction_at(const std::string& path) {
  if (is_of_accuracy(path)) {
    auto names = parameters()[parameter_with(Role::preset)].choices;
    names.emplace_back("custom");
    return named(std::move(names));
  }
  const std::size_t shape = parameter_with(Role::shape);
  const auto index = find_parameter(path);
  if (index == shape) {
    auto names = parameters()[shape].choices;
    names.insert(names.end(), {"hull", "mixture"});
    return named(std::move(names));
  }
  if (index) return parameters()[*index];
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
    const auto list = find_parameter(path.substr(0, dot));
    if (!list) continue;
    Parameter part = parameters()[*list];
    if (part.kind == ValueKind::components) return part;
    if (part.kind != ValueKind::numbers) continue;
    part.kind = ValueKind::number;
    return part;
  }
  return std::nullopt;
}

/// Whether its values are read as in a sweep. Packings hold others as hashes, or in parts.
bool is_read_as_written(const Parameter& parameter) {
  return parameter.kind == ValueKind::number || parameter.kind == ValueKind::whole ||
         parameter.kind == ValueKind::natural || parameter.kind == ValueKind::choice;
}

/// Notes what no packing can have.
void check_distinction(const std::string& path, const Json& value, const std::string& pointer,
                       Diagnostics& diagnostics) {
  const auto note = [&](const std::string& message, Anchor anchor = Anchor::value) {
    diagnostics.push_back({pointer, message, anchor});
  };
  if (path == "seed") {
    return note("families are not told apart by their seed; leave it out", Anchor::key);
  }
  const auto distinction = distinction_at(path);
  const bool is_known = distinction || is_group(path);
  if (!is_known || path.empty()) {
    std::vector<std::string> known = {"accuracy"};
    for (const Parameter& one : parameters()) known.push_back(one.path);
    std::erase(known, "seed");
    for (const std::string& whole : known) {
      if (path.empty() || !whole.ends_with("." + path)) continue;
      return note("unknown key \"" + path + "\"; did you mean \"" + whole + "\"?", Anchor::key);
    }
    const std::string how =
        nearest(path, known).empty() ? ", and all other parameters by their dotted names" : "";
    return note(unknown_key(path, known) + how, Anchor::key);
  }
  if (!distinction || value.is_object()) {
    return note("give each part by its dotted name, as \"sizes.small_share\"");
  }
  if (value.is_array()) {
    return note("give each number by its place in the list, as \"measure.gap_tolerances.0\"");
  }
  if (!is_read_as_written(*distinction)) return;
  const ValueReading reading = read_value(*distinction, value);
  const std::string error =
      reading.value ? range_error(*distinction, *reading.value) : reading.error;
  if (!error.empty()) note(error);
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
  const std::string place = child_pointer(pointer, "where");
  for (const auto& [path, value] : from["where"].items()) {
    check_distinction(path, value, child_pointer(place, path), diagnostics);
    family.where[path] = plain(value);
  }
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
    if (!reference.common[k].formula) continue;
    diagnostics.push_back({"/common/" + std::to_string(k) + "/formula",
                           "formulas belong to \"families\"; { } as \"where\" means all of them",
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

std::string reference_beside(const std::string& sweep_file) {
  const std::string ending = ".json";
  const bool has_ending = sweep_file.ends_with(ending);
  return sweep_file.substr(0, sweep_file.size() - (has_ending ? ending.size() : 0)) +
         ".reference.json";
}

std::string kept_reference(const std::string& folder) { return folder + "/reference.json"; }

bool describes(const PublishedFamily& published, const Family& family) {
  const json known = json::parse(family.parameters).flatten();
  return std::all_of(published.where.begin(), published.where.end(), [&](const auto& entry) {
    const std::vector<std::string> own = values_at(entry.first, family, known);
    return std::find(own.begin(), own.end(), entry.second) != own.end();
  });
}

std::string values_in(const std::vector<Family>& families, const std::string& path) {
  constexpr std::size_t most = 8;
  std::vector<std::string> values;
  for (const Family& family : families) {
    for (const std::string& value :
         values_at(path, family, json::parse(family.parameters).flatten())) {
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  }
  std::string text;
  for (std::size_t k = 0; k < std::min(most, values.size()); ++k) {
    text += (k == 0 ? "" : ", ") + values[k];
  }
  if (values.size() > most) text += " and " + std::to_string(values.size() - most) + " more";
  const auto known = find_parameter(path);
  const std::string unit = known ? parameters()[*known].unit : "";
  return text.empty() || unit.empty() ? text : text + " " + unit;
}

std::string advice_on(const std::string& path) {
  if (path == "box.width" || path == "tube.diameter") {
    return "a family has packings of any " + path +
           ": leave it out of \"where\", and give values their \"width\"";
  }
  if (path == "box.y") {
    return "a family has packings with walls and without: leave box.y out of \"where\"; quantities "
           "that end in _unconfined are of those without";
  }
  return "";
}

}  // namespace grainsweep
