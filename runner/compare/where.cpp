#include "runner/compare/where.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

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

}  // namespace

Where read_where(const Json& from, const std::string& pointer, Diagnostics& diagnostics) {
  Where where;
  for (const auto& [path, value] : from.items()) {
    check_distinction(path, value, child_pointer(pointer, path), diagnostics);
    where[path] = plain(value);
  }
  return where;
}

bool describes(const Where& where, const Family& family) {
  const json known = json::parse(family.parameters).flatten();
  return std::all_of(where.begin(), where.end(), [&](const auto& entry) {
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
