#include "runner/sweep/schema_words.hpp"

#include <cmath>
#include <map>

namespace grainsweep {
namespace {

/// Any key of these groups, "a|b".
Json is_about(const std::string& groups) { return {{"pattern", "^(" + groups + ")(\\.|$)"}}; }

Json any_of(const std::vector<Json>& schemas) {
  if (schemas.size() == 1) return schemas[0];
  return {{"anyOf", schemas}};
}

/// What the object at `prefix` may hold: each mentioned parameter below it in each way to write it.
Json members_of(const std::string& prefix, const std::vector<Mention>& mentions) {
  std::map<std::string, std::vector<Json>> ways;
  for (const Mention& mention : mentions) {
    if (!mention.path.starts_with(prefix)) continue;
    const std::string rest = mention.path.substr(prefix.size());
    ways[rest].push_back(mention.value);
    for (std::size_t dot = rest.find('.'); dot != std::string::npos;
         dot = rest.find('.', dot + 1)) {
      std::vector<Json>& inside = ways[rest.substr(0, dot)];
      const std::string group = prefix + rest.substr(0, dot + 1);
      if (inside.empty() || !inside.back().contains("properties")) {
        inside.push_back({{"type", "object"},
                          {"additionalProperties", false},
                          {"properties", members_of(group, mentions)}});
      }
    }
  }
  Json members = Json::object();
  for (const auto& [key, values] : ways) members[key] = any_of(values);
  return members;
}

/// An object of parameters that says nothing about the groups but these members.
Json layer_with(const Json& members, const std::string& groups) {
  std::vector<Json> names = {no(is_about(groups))};
  for (const auto& [key, value] : members.items()) names.push_back({{"const", key}});
  return {{"propertyNames", any_of(names)}, {"properties", members}};
}

/// All that a block takes: one value, a list, evenly spaced ones, and what is drawn at random.
Json each_like(const Json& value) {
  if (value.empty()) return value;
  return any_of(
      {value,
       list_like(value),
       {{"type", "object"},
        {"required", {"from", "to"}},
        {"properties", {{"from", value}, {"to", value}}}},
       {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", list_like(value)}}});
}

}  // namespace

std::vector<double> round_numbers(double least, double most) {
  std::vector<double> all;
  for (int decade = static_cast<int>(std::floor(std::log10(least))); decade <= std::log10(most);
       ++decade) {
    for (const double digits : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
      const double unit = std::pow(10.0, std::abs(decade));
      const double value = decade < 0 ? digits / unit : digits * unit;
      if (value >= least && value <= most) all.push_back(value);
    }
  }
  return all;
}

Json no(const Json& schema) { return {{"not", schema}}; }

Json not_all(const std::vector<Json>& schemas) { return no({{"allOf", schemas}}); }

Json with(const std::string& member, const Json& schema) {
  return {{"required", {member}}, {"properties", {{member, schema}}}};
}

std::vector<Json> spellings(const std::string& path, const Json& value) {
  std::vector<Json> all = {{{"required", {path}}}};
  if (!value.empty()) all[0]["properties"] = {{path, value}};
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
    for (Json inside : spellings(path.substr(dot + 1), value)) {
      inside["type"] = "object";
      all.push_back(with(path.substr(0, dot), inside));
    }
  }
  return all;
}

Json in_any_way(const std::string& path, const Json& value) {
  return {{"anyOf", spellings(path, value)}};
}

Json number_with(const Json& bounds) {
  Json schema = bounds;
  schema["type"] = "number";
  return schema;
}

Json list_like(const Json& entry) { return {{"type", "array"}, {"items", entry}}; }

Json says_only(const std::string& groups, const std::vector<Mention>& anywhere,
               const std::vector<Mention>& in_base) {
  Json varied = Json::object();
  for (const Mention& mention : anywhere) varied[mention.path] = each_like(mention.value);
  const Json layer = layer_with(varied, groups);
  Json blocks = Json::object();
  for (const char* const member : {"set", "grid", "zip", "random"}) blocks[member] = layer;
  std::vector<Mention> all = anywhere;
  all.insert(all.end(), in_base.begin(), in_base.end());
  return {{"properties",
           {{"base", layer_with(members_of("", all), groups)},
            {"sweep", {{"items", {{"properties", blocks}}}}}}}};
}

}  // namespace grainsweep
