#include "runner/sweep/schema.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/random_paths.hpp"
#include "runner/sweep/read_replicates.hpp"
#include "runner/sweep/schema_edges.hpp"
#include "runner/sweep/schema_rules.hpp"
#include "runner/sweep/spaced_values.hpp"
#include "runner/sweep/sweep_definition.hpp"
#include "runner/sweep/units.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {
namespace {

Json reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

Json list_of(const Json& items) { return {{"type", "array"}, {"minItems", 1}, {"items", items}}; }

/// An object with these members and no other.
Json closed_object(const Json& members) {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", members}};
}

Json whole_number(std::int64_t least, std::int64_t most) {
  return {{"type", "integer"}, {"minimum", least}, {"maximum", most}};
}

Json described(const std::string& description, Json schema) {
  schema["description"] = description;
  return schema;
}

Json point() {
  return {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", {{"type", "number"}}}};
}

/// For points: they do not all have x = 0, nor y = 0, nor z = 0.
Json off_each_coordinate_plane() {
  Json rules = Json::array(), items = Json::array();
  for (int axis = 0; axis < 3; ++axis) {
    items.push_back({{"not", {{"const", 0}}}});
    rules.push_back({{"contains", {{"items", items}}}});
    items.back() = Json::object();
  }
  return rules;
}

/// A number of this type in the parameter's range.
Json number(const char* type, const Parameter& parameter) {
  Json schema = {{"type", type}};
  if (!parameter.range) return schema;
  const Interval& range = *parameter.range;
  schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) {
    schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  }
  return schema;
}

/// Every name by itself, so that editors show what it means.
Json names_of(const Parameter& parameter) {
  Json names = Json::array();
  for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
    names.push_back(described(parameter.choice_meanings[i], {{"const", parameter.choices[i]}}));
  }
  return {{"anyOf", names}};
}

/// Components of a mixture: each a share and a shape.
Json components() {
  Json members = {{"share", described("of the mixture, 0 to 1; all of them add up to 1",
                                      {{"type", "number"}, {"minimum", 0}, {"maximum", 1}})}};
  for (const std::string_view name : shape_names) {
    if (name == "sphere" || name == "mixture" || name == "hull") continue;
    members[std::string(name)] = reference("shape." + std::string(name));
  }
  members["sphere"] = described("a sphere of diameter d", closed_object(Json::object()));
  members["hull"] = closed_object({{"vertices", reference("shape.hull.vertices")},
                                   {"file", reference("shape.hull.file")},
                                   {"size", reference("shape.hull.size")}});
  members["hull"]["anyOf"] = Json::array({{{"required", {"vertices"}}}, {{"required", {"file"}}}});
  members["hull"]["not"] = {{"required", {"vertices", "file"}}};
  Json component = closed_object(members);
  component["required"] = Json::array({"share"});
  component["minProperties"] = component["maxProperties"] = 2;
  Json list = list_of(component);
  list["maxItems"] = most_components;
  return list;
}

Json kind_schema(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::number:
      return number("number", parameter);
    case ValueKind::whole:
      return number("integer", parameter);
    case ValueKind::natural:
      return {{"type", "integer"}, {"minimum", 0}, {"maximum", UINT64_MAX}};
    case ValueKind::text:
      return {{"type", "string"}, {"minLength", 1}};
    case ValueKind::texts: {
      Json list = list_of({{"type", "string"}, {"minLength", 1}});
      list["uniqueItems"] = true;
      return list;
    }
    case ValueKind::numbers: {
      Json list = list_of(number("number", parameter));
      list["maxItems"] = parameter.most_items;
      if (parameter.are_distinct) list["uniqueItems"] = true;
      return list;
    }
    case ValueKind::points: {
      Json list = list_of(point());
      list["minItems"] = 4;
      list["allOf"] = off_each_coordinate_plane();
      return list;
    }
    case ValueKind::components:
      return components();
    case ValueKind::choice:
      break;
  }
  return names_of(parameter);
}

/// An object of any parameters, in which each is said once.
Json layer(const Json& members) {
  Json schema = closed_object(members);
  schema["allOf"] = Json::array({reference("each once")});  // {…} of one Json: compilers differ
  return schema;
}

/// A parameter or a group in "base" or "set". A tube needs its diameter there; in a list, where
/// other rows may be boxes, an empty tube says nothing.
Json held(const std::string& path) {
  if (path != "tube") return reference(path);
  return described(meaning_of_group(path),
                   {{"allOf", {reference(path), {{"required", {"diameter"}}}}}});
}

Json group_members(const std::string& group) {
  Json members;
  for (const std::string& key : known_keys(group)) members[key] = reference(group + "." + key);
  Json schema = described(meaning_of_group(group), closed_object(members));
  if (Json rules = said_once(group); !rules.empty()) schema["allOf"] = std::move(rules);
  return schema;
}

/// A parameter that is also the name of a group is written as a value or as an object of its parts.
Json parameter_schema(const Parameter& parameter) {
  Json schema = {{"description", parameter.meaning}};
  if (is_group(parameter.path)) {
    schema["anyOf"] = {kind_schema(parameter), group_members(parameter.path)};
  } else {
    schema.update(kind_schema(parameter));
  }
  const auto value = default_of(parameter);
  if (value) schema["default"] = written_value(parameter, *value);
  return schema;
}

Json group_schema(const std::string& group) {
  Json object = group_members(group);
  const auto preset = preset_of(group);
  if (!preset) return object;
  return described(meaning_of_group(group),
                   {{"anyOf", {reference(parameters()[*preset].path), object}}});
}

/// A member for every parameter and group, by dotted path, made from it by `make`.
template <class Make>
Json members_by_path(Make make) {
  Json members;
  for (const std::string& path : known_keys("")) {
    if (Json schema = make(path); !schema.is_null()) members[path] = std::move(schema);
  }
  return members;
}

std::string meaning_of(const std::string& path) {
  const auto parameter = find_parameter(path);
  return parameter ? parameters()[*parameter].meaning : meaning_of_group(path);
}

/// Evenly spaced values.
Json spaced(const std::string& path) {
  Json object =
      closed_object({{"from", described("the first value", reference(path))},
                     {"to", described("the last value", reference(path))},
                     {"count", described("values in all", whole_number(2, most_spaced_values))}});
  object["required"] = {"from", "to", "count"};
  return object;
}

Json lists(const std::string& what) {
  return closed_object(members_by_path([&](const auto& path) {
    return described(what + meaning_of(path), list_of(reference(path)));
  }));
}

/// For a grid: a value that is there twice would be packed twice. Numbers may be spaced evenly.
Json distinct_lists() {
  return closed_object(members_by_path([&](const auto& path) {
    Json list = list_of(reference(path));
    list["uniqueItems"] = true;
    if (is_interval(path)) list = {{"anyOf", {list, spaced(path)}}};
    return described("every one of these: " + meaning_of(path), list);
  }));
}

/// Parameters as "base" holds them: the seed belongs beside it.
Json base_schema() {
  const std::string& seed = parameters()[parameter_with(Role::seed)].path;
  return layer(
      members_by_path([&](const auto& path) { return path == seed ? Json() : held(path); }));
}

/// A way to draw a value.
Json way(const char* name, const char* description, const Json& value) {
  Json object = closed_object({{name, described(description, value)}});
  object["required"] = {name};
  return object;
}

Json distribution(const std::string& path) {
  Json choice = way("choice", "one of these, each as likely", list_of(reference(path)));
  if (!is_interval(path)) return choice;
  Json bounds = list_of(reference(path));
  bounds["minItems"] = bounds["maxItems"] = 2;
  bounds["allOf"] = Json::array({reference("ascending")});
  Json above_zero = bounds;
  above_zero["items"] = {{"allOf", {reference(path), {{"exclusiveMinimum", 0}}}}};
  return {{"anyOf",
           {way("uniform", "as likely everywhere between the two", bounds),
            way("log_uniform", "the same of its logarithm", above_zero), choice}}};
}

Json random_schema() {
  Json members = {{"count", described("points to draw", whole_number(1, most_random_points))}};
  members.update(members_by_path([](const auto& path) {
    return described("drawn: " + meaning_of(path), distribution(path));
  }));
  Json random = closed_object(members);
  random["required"] = {"count"};
  return random;
}

Json replicates() {
  const auto error_of = [](const char* what) {
    return described(what, {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1}});
  };
  Json fit = closed_object({{"phi_bulk", error_of("largest error of it")},
                            {"C", error_of("largest error of it, d")},
                            {"Z_bulk", error_of("largest error of it")},
                            {"C_Z", error_of("largest error of it, d")}});
  fit["minProperties"] = 1;
  Json until =
      closed_object({{"solid_fraction", error_of("largest error of its mean")},
                     {"coordination", error_of("largest error of its mean")},
                     {"fit", described("in place of means: the wall effect of each family, "
                                       "phi = phi_bulk - C / W and Z = Z_bulk - C_Z / W",
                                       std::move(fit))}});
  until["minProperties"] = 1;
  until["dependencies"] = {{"fit", {{"maxProperties", 1}}}};
  Json growing = closed_object(
      {{"until", described("packings are added until the means are known so well: half of the 95 % "
                           "interval, with what the way of settling may do to them",
                           std::move(until))},
       {"most", described("the most packings of a point", whole_number(2, most_replicates))}});
  growing["required"] = {"until"};
  return described("packings of each point, with other random numbers",
                   {{"anyOf", {whole_number(1, most_replicates), std::move(growing)}}});
}

Json block_schema() {
  Json zipped = lists("side by side: ");
  zipped["allOf"] = distinct_rows();
  zipped["allOf"].push_back(equally_long());
  Json block = closed_object(
      {{"label",
        described("name of the block in the tables",
                  {{"type", "string"},
                   {"minLength", 1},
                   {"maxLength", 100},
                   {"pattern", "^[^=+@\\u0000-\\u001f\\u007f-][^\\u0000-\\u001f\\u007f]*$"}})},
       {"set", described("values for the whole block",
                         layer(members_by_path([](const auto& path) { return held(path); })))},
       {"grid", described("lists of values: every combination of them", distinct_lists())},
       {"zip", described("equally long lists: taken side by side", std::move(zipped))},
       {"random", described("points drawn at random", random_schema())},
       {"replicates", replicates()}});
  block["allOf"] = set_or_varied();
  return block;
}

Json definitions() {
  Json all = {{"each once", {{"allOf", said_once("")}}}, {"ascending", {{"allOf", ascending()}}}};
  for (const std::string& path : known_keys("")) {
    if (!find_parameter(path)) all[path] = group_schema(path);
  }
  for (const Parameter& parameter : parameters()) {
    all[parameter.path] = parameter_schema(parameter);
  }
  return all;
}

Json name_schema() {
  return {{"description", "name of the sweep and of its folder in out/"},
          {"type", "string"},
          {"pattern", "^[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}$"}};
}

Json units_schema() {
  Json names = Json::array();
  for (const char* const unit : length_units) names.push_back({{"const", unit}});
  Json units = closed_object(
      {{"d", described("mean diameter of the large grains, in `unit`",
                       {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", largest_length}})},
       {"unit", described("that lengths are printed in, too", {{"anyOf", names}})},
       {"density", described("of the grains' solid, kg/m3", {{"type", "number"},
                                                             {"minimum", least_density},
                                                             {"maximum", largest_density}})}});
  units["required"] = {"d", "unit"};
  return units;
}

/// Writes members for people, line by line; rules, which nobody reads, one per line.
std::string written(const Json& schema) {
  std::string text;
  for (const auto& [key, value] : schema.items()) {
    text += (text.empty() ? "{\n" : ",\n") + Json(key).dump() + ": ";
    if (key != "allOf") {
      text += value.dump(1);
      continue;
    }
    for (const Json& rule : value) text += (&rule == &value[0] ? "[\n" : ",\n") + rule.dump();
    text += "\n]";
  }
  return text + "\n}\n";
}

}  // namespace

std::string sweep_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "Sweep of grainsweep"},
                 {"description",
                  "Which beds to pack. Lengths are in d, the mean diameter of the "
                  "large grains."}};
  schema.update(closed_object(
      {{"$schema", described("the schema of this file, for editors", {{"type", "string"}})},
       {"name", name_schema()},
       {"seed", described("master seed of the random numbers",
                          kind_schema(parameters()[parameter_with(Role::seed)]))},
       {"replicates", replicates()},
       {"units",
        described("what d is in a laboratory; packings do not depend on it", units_schema())},
       {"base", described("what all packings share", base_schema())},
       {"sweep", described("blocks of packings, joined", list_of(block_schema()))}}));
  schema["required"] = {"name"};
  schema["allOf"] = rules_of_the_whole();
  for (Json& rule : edge_rules()) schema["allOf"].push_back(std::move(rule));
  schema["definitions"] = definitions();
  return written(schema);
}

}  // namespace grainsweep
