#include "runner/compare/reference.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/compare/quantities.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

using nlohmann::json;

/// What an exception says, without the name that the JSON library gives it.
std::string fault_of(const std::exception& error) {
  const std::string text = error.what();
  const bool is_named = text.starts_with("[json.exception.");
  return is_named ? text.substr(text.find("] ") + 2) : text;
}

void expect_keys(const json& object, const std::vector<std::string>& known) {
  if (!object.is_object()) throw BadInput("must be an object, is " + object.dump());
  for (const auto& [key, value] : object.items()) {
    const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
    if (!is_known) throw BadInput(unknown_key(key, known));
  }
}

Published::Range published_range(const json& value, double error) {
  const bool is_range = value.is_array();
  if (is_range ? value.size() != 2 : !value.is_number()) {
    throw BadInput("value must be a number or a range [low, high], is " + value.dump());
  }
  if (!(error >= 0.0)) throw BadInput("error must not be negative, is " + cell(error));
  const Published::Range range{is_range ? value.at(0) : value, is_range ? value.at(1) : value,
                               error};
  if (range.low > range.high) throw BadInput("a range must be [low, high]");
  return range;
}

std::string text_of(const std::optional<Published::Range>& range) {
  if (!range) return "-";
  if (range->low < range->high) return cell(range->low) + " to " + cell(range->high);
  return cell(range->low) + (range->error > 0.0 ? " ± " + cell(range->error) : "");
}

Published read_published(const json& from) {
  expect_keys(from, {"quantity", "width", "value", "error", "text", "definition"});
  if (!from.contains("quantity")) throw BadInput("needs \"quantity\", its name");
  Published published{.quantity = from.at("quantity"),
                      .width = from.value("width", 0.0),
                      .text = {},
                      .range = {},
                      .definition = from.value("definition", "")};
  const std::string fault = fault_of_quantity(published.quantity, published.width);
  if (!fault.empty()) throw BadInput(fault);
  if (from.contains("value"))
    published.range = published_range(from["value"], from.value("error", 0.0));
  published.text = from.value("text", text_of(published.range));
  return published;
}

/// `read` of each element of the list under `key`; what it throws gets the place before it.
template <typename Read>
auto read_list(const json& object, const std::string& key, const Read& read) {
  std::vector<decltype(read(object))> elements;
  const json list = object.value(key, json::array());
  if (!list.is_array()) throw BadInput(key + " must be a list, is " + list.dump());
  for (const json& element : list) {
    try {
      elements.push_back(read(element));
    } catch (const std::exception& error) {
      throw BadInput("/" + key + "/" + std::to_string(elements.size()) + ": " + fault_of(error));
    }
  }
  return elements;
}

/// A value as `describes` compares it: 0 and 0.0 are one.
std::string plain(const json& value) {
  return value.is_number() ? json(value.get<double>()).dump() : value.dump();
}

/// The parameter that `path` is or lies in: a number of a list is written "gap_tolerances.0".
const Parameter* parameter_at(std::string path) {
  while (true) {
    if (const auto index = find_parameter(path)) return &parameters()[*index];
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return nullptr;
    path.resize(dot);
  }
}

void expect_one_of(std::vector<std::string> names, const json& value) {
  const bool is_known = value.is_string() && std::find(names.begin(), names.end(),
                                                       value.get<std::string>()) != names.end();
  if (is_known) return;
  const std::string near = value.is_string() ? nearest(value.get<std::string>(), names) : "";
  throw BadInput(
      "is " + value.dump() +
      (near.empty() ? ", not one of: " + comma_list(names) : "; did you mean \"" + near + "\"?"));
}

/// Throws BadInput unless packings can have this value of this parameter.
void check_distinction(const std::string& path, const json& value) {
  if (path == "accuracy" || path == "accuracy.preset") {
    std::vector<std::string> names = {"custom"};
    for (const Preset& preset : presets()) names.emplace_back(preset.name);
    return expect_one_of(names, value);
  }
  if (path == "seed") throw BadInput("families are not told apart by their seed; leave it out");
  if (value.is_object()) {
    throw BadInput("give each part by its dotted name, as \"sizes.small_share\"");
  }
  const Parameter* const parameter = parameter_at(path);
  if (parameter == nullptr) {
    std::vector<std::string> known = {"accuracy"};
    for (const Parameter& one : parameters()) known.push_back(one.path);
    throw BadInput(unknown_key(path, known));
  }
  std::vector<std::string> names = parameter->choices;
  if (path == "shape") names.emplace_back("mixture");
  if (!names.empty()) return expect_one_of(names, value);
  const bool is_number = parameter->kind == ValueKind::number ||
                         parameter->kind == ValueKind::whole ||
                         parameter->kind == ValueKind::natural;
  if (is_number && !value.is_number()) throw BadInput("must be a number, is " + value.dump());
}

PublishedFamily read_family(const json& from) {
  expect_keys(from, {"where", "values"});
  if (!from.contains("where") || !from["where"].is_object()) {
    throw BadInput("needs \"where\", an object with what the parameters of the family are");
  }
  PublishedFamily family{.where = {}, .values = read_list(from, "values", read_published)};
  for (const auto& [path, value] : from.at("where").items()) {
    try {
      check_distinction(path, value);
    } catch (const BadInput& error) {
      throw BadInput("/where/" + path + ": " + error.what());
    }
    family.where[path] = plain(value);
  }
  return family;
}

Reference reference_of(const json& from) {
  expect_keys(from, {"source", "families", "common"});
  if (!from.contains("source")) throw BadInput("needs \"source\", where the values are from");
  if (!from.contains("families") && !from.contains("common")) {
    throw BadInput("needs \"families\" or \"common\", lists of published values");
  }
  return {.source = from.at("source"),
          .families = read_list(from, "families", read_family),
          .common = read_list(from, "common", read_published)};
}

}  // namespace

Reference read_reference(const std::string& path) {
  const std::string text = read_file(path);
  try {
    return reference_of(json::parse(text));
  } catch (const std::exception& error) {
    throw BadInput(path + ": " + fault_of(error));
  }
}

std::string reference_beside(const std::string& sweep_file) {
  const std::string ending = ".json";
  const bool has_ending = sweep_file.ends_with(ending);
  return sweep_file.substr(0, sweep_file.size() - (has_ending ? ending.size() : 0)) +
         ".reference.json";
}

bool describes(const PublishedFamily& published, const Family& family) {
  const JobFacts& job = first_group(family).job;
  const json known = json::parse(family.parameters).flatten();
  return std::all_of(published.where.begin(), published.where.end(), [&](const auto& entry) {
    const auto& [path, value] = entry;
    if (path == "shape") return value == plain(job.shape);
    if (path == "accuracy" || path == "accuracy.preset") {
      return value == plain(job.accuracy) || value == plain(job.settles_as);
    }
    std::string pointer = "/" + path;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    return known.contains(pointer) && plain(known[pointer]) == value;
  });
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
