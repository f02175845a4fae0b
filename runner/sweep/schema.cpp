#include "runner/sweep/schema.hpp"

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/random_paths.hpp"
#include "runner/sweep/sweep_definition.hpp"
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

Json point() {
  return {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", {{"type", "number"}}}};
}

Json kind_of(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::number:
      return {{"type", "number"}};
    case ValueKind::whole:
      return whole_number(-parameter.largest, parameter.largest);
    case ValueKind::natural:
      return {{"type", "integer"}, {"minimum", 0}};
    case ValueKind::text:
      return {{"type", "string"}};
    case ValueKind::texts:
      return list_of({{"type", "string"}});
    case ValueKind::numbers:
      return {{"type", "array"}, {"items", {{"type", "number"}}}};
    case ValueKind::points:
      return {{"type", "array"}, {"items", point()}};
    case ValueKind::choice:
      break;
  }
  return {{"enum", parameter.choices}};
}

Json group_members(const std::string& group) {
  Json members;
  for (const std::string& key : known_keys(group)) members[key] = reference(group + "." + key);
  return closed_object(members);
}

/// A parameter that is also the name of a group is written as a value or as an object of its parts.
Json parameter_schema(const Parameter& parameter) {
  Json schema = {{"description", parameter.meaning}};
  if (is_group(parameter.path)) {
    schema["anyOf"] = {kind_of(parameter), group_members(parameter.path)};
  } else {
    schema.update(kind_of(parameter));
  }
  const auto value = default_of(parameter);
  if (value) schema["default"] = written_value(parameter, *value);
  return schema;
}

Json group_schema(const std::string& group) {
  Json object = group_members(group);
  const auto preset = preset_of(group);
  if (!preset) return object;
  return {{"anyOf", {reference(parameters()[*preset].path), object}}};
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

Json lists() {
  return closed_object(members_by_path([](const auto& path) { return list_of(reference(path)); }));
}

/// Parameters as "base" holds them: the seed belongs beside it.
Json base_schema() {
  const std::string& seed = parameters()[parameter_with(Role::seed)].path;
  return closed_object(
      members_by_path([&](const auto& path) { return path == seed ? Json() : reference(path); }));
}

Json one_member(const char* name, const Json& value) {
  Json object = closed_object({{name, value}});
  object["required"] = {name};
  return object;
}

Json distribution(const std::string& path) {
  Json choice = one_member("choice", list_of(reference(path)));
  const auto index = find_parameter(path);
  const bool is_interval = index && (parameters()[*index].kind == ValueKind::number ||
                                     parameters()[*index].kind == ValueKind::whole);
  if (!is_interval) return choice;
  Json bounds = list_of(reference(path));
  bounds["minItems"] = bounds["maxItems"] = 2;
  return {{"anyOf", {one_member("uniform", bounds), one_member("log_uniform", bounds), choice}}};
}

Json random_schema() {
  Json members = {{"count", whole_number(1, most_random_points)}};
  members.update(members_by_path([](const auto& path) { return distribution(path); }));
  Json random = closed_object(members);
  random["required"] = {"count"};
  return random;
}

Json described(const char* description, Json schema) {
  schema["description"] = description;
  return schema;
}

Json replicates() {
  return described("packings of each point, with other random numbers",
                   whole_number(1, most_replicates));
}

Json block_schema() {
  return closed_object(
      {{"label", described("name of the block in the tables", {{"type", "string"}})},
       {"set", described("values for the whole block",
                         closed_object(
                             members_by_path([](const auto& path) { return reference(path); })))},
       {"grid", described("lists of values: every combination of them", lists())},
       {"zip", described("equally long lists: taken side by side", lists())},
       {"random", described("points drawn at random", random_schema())},
       {"replicates", replicates()}});
}

Json definitions() {
  Json all;
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
       {"seed",
        described("master seed of the random numbers", {{"type", "integer"}, {"minimum", 0}})},
       {"replicates", replicates()},
       {"base", described("what all packings share", base_schema())},
       {"sweep", described("blocks of packings, joined", list_of(block_schema()))}}));
  schema["required"] = {"name"};
  schema["definitions"] = definitions();
  return schema.dump(2) + "\n";
}

}  // namespace grainsweep
