#include "runner/sweep/schema_rules.hpp"

#include <utility>
#include <vector>

#include "runner/sweep/asked_accuracy.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/schema_words.hpp"
#include "runner/sweep/size_formulas.hpp"

namespace grainsweep {
namespace {

Json not_both(const Json& one, const Json& other) { return not_all({one, other}); }

/// That an object has a key that matches.
Json has_key(const std::string& pattern) {
  return {{"type", "object"}, {"not", {{"propertyNames", no({{"pattern", pattern}})}}}};
}

/// That a layer gives the formula of its distribution of sizes, or a part of one, in any spelling.
Json has_size_formula() {
  const std::string formula = "(" + size_formula_names("|", "|") + ")(\\.|$)";
  const Json inside = has_key("^" + formula);
  const Json in_sizes = {
      {"anyOf", {has_key("^distribution\\." + formula), with("distribution", inside)}}};
  return {{"anyOf",
           {has_key("^sizes\\.distribution\\." + formula), with("sizes.distribution", inside),
            with("sizes", in_sizes)}}};
}

/// That a block says anything that matches.
Json with_block_about(const std::string& pattern) {
  const Json about = has_key(pattern);
  std::vector<Json> ways;
  for (const char* member : {"set", "grid", "zip", "random"}) ways.push_back(with(member, about));
  return with("sweep", {{"contains", {{"anyOf", ways}}}});
}

/// Groups and parameters of sizes of which only one may be given.
std::vector<std::pair<std::string, std::string>> alternative_sizes() {
  const std::string all = "sizes.distribution", table = all + ".table.";
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const char* const part : {"sizes.spread", "sizes.small_share", "sizes.size_ratio"}) {
    pairs.emplace_back(all, part);
  }
  const auto path_of = [&](std::size_t kind) {
    return all + "." + std::string(size_formula_kinds()[kind].name);
  };
  for (std::size_t i = 0; i < size_formula_kinds().size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) pairs.emplace_back(path_of(j), path_of(i));
  }
  for (const char* const part : {"diameters", "passing", "shares"}) {
    pairs.emplace_back(table + "file", table + part);
  }
  pairs.emplace_back(table + "passing", table + "shares");
  return pairs;
}

/// Keys that begin with this name: "cube", "cube.edge".
Json begins_with(const std::string& name) { return {{"pattern", "^" + name + "(\\.|$)"}}; }

/// Matches the keys of a shape; those of a mixture begin with the same letters.
std::string keys_of(std::string_view name) {
  return std::string(name) + (name == "mixture" ? "(_by)?" : "");
}

/// That all keys of the object "shape" are parts of one shape.
Json one_shape_inside() {
  Json ways = Json::array();
  for (const std::string_view name : shape_names) {
    ways.push_back({{"propertyNames", begins_with(keys_of(name))}});
  }
  return {{"anyOf", ways}};
}

/// That an object of parameters gives one shape, by name, by its parts, or none.
Json one_shape() {
  const Json about_others = no(begins_with("shape\\.[a-z_]+"));
  std::vector<Json> ways;
  for (const std::string_view name : shape_names) {
    const Json here = begins_with("shape\\." + keys_of(name));
    const Json parts = {{"type", "object"}, {"propertyNames", begins_with(keys_of(name))}};
    const Json shape = {{"anyOf", {{{"const", name}}, parts}}};
    ways.push_back(
        {{"propertyNames", {{"anyOf", {about_others, here}}}}, {"properties", {{"shape", shape}}}});
  }
  return {{"anyOf", ways}};
}

/// For a layer, or the group: beside a requested accuracy there is no preset, nor a part that
/// changes how beds settle.
Json asked_for_alone(const std::string& group) {
  const std::string all = "accuracy.";
  const std::size_t inside = group.empty() ? 0 : all.size();
  std::vector<Json> asked, others;
  for (const Parameter& parameter : parameters()) {
    if (!parameter.path.starts_with(all) || leaves_the_bound(parameter)) continue;
    const bool asks = parameter.role == Role::asked_accuracy;
    (asks ? asked : others).push_back(in_any_way(parameter.path.substr(inside)));
  }
  if (group.empty()) others.push_back(with("accuracy", {{"type", "string"}}));
  return not_both({{"anyOf", asked}}, {{"anyOf", others}});
}

}  // namespace

Json said_once(const std::string& group) {
  static const std::vector<std::pair<std::string, std::string>> alternatives = [] {
    std::vector<std::pair<std::string, std::string>> pairs = {
        {"shape.hull.vertices", "shape.hull.file"}, {"box", "tube"}};
    for (const auto& [one, other] : alternative_sizes()) pairs.emplace_back(one, other);
    for (std::size_t i = 0; i < parameters().size(); ++i) {
      for (std::size_t j = 0; is_fill(i) && j < i; ++j) {
        if (is_fill(j)) pairs.emplace_back(parameters()[j].path, parameters()[i].path);
      }
    }
    return pairs;
  }();
  const std::string prefix = group.empty() ? "" : group + ".";
  const auto is_inside = [&](const std::string& path) { return path.starts_with(prefix); };
  const auto inside = [&](const std::string& path) { return path.substr(prefix.size()); };
  Json rules = Json::array();
  if (group == "shape") rules.push_back(one_shape_inside());
  if (group.empty()) rules.push_back(one_shape());
  if (group.empty() || group == "accuracy") rules.push_back(asked_for_alone(group));
  for (const auto& [one, other] : alternatives) {
    if (!is_inside(one) || !is_inside(other)) continue;
    rules.push_back(not_both(in_any_way(inside(one)), in_any_way(inside(other))));
  }
  for (const Parameter& parameter : parameters()) {
    if (!is_inside(parameter.path)) continue;
    const std::vector<Json> ways = spellings(inside(parameter.path));
    for (std::size_t i = 0; i < ways.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) rules.push_back(not_both(ways[j], ways[i]));
    }
  }
  return rules;
}

Json equally_long() {
  constexpr int longest = 24;
  std::vector<Json> lengths;
  for (int items = 1; items <= longest; ++items) {
    lengths.push_back({{"additionalProperties", {{"minItems", items}, {"maxItems", items}}}});
  }
  lengths.push_back({{"additionalProperties", {{"minItems", longest + 1}}}});
  return {{"anyOf", lengths}};
}

Json distinct_rows() {
  const Json repeats = {{"minItems", 2}, {"maxItems", 2}, {"not", {{"uniqueItems", true}}}};
  const Json one_list = {{"maxProperties", 1}}, distinct = {{"uniqueItems", true}};
  return Json::array({not_all({{{"minProperties", 1}, {"additionalProperties", repeats}}}),
                      {{"anyOf", {no(one_list), {{"additionalProperties", distinct}}}}}});
}

Json ascending() {
  const auto falls_below = [](double value) {
    return no({{"items", {{{"minimum", value}}, {{"exclusiveMaximum", value}}}}});
  };
  Json rules = Json::array({falls_below(0.0)});
  for (const double value : round_numbers(1e-6, 1e7)) rules.push_back(falls_below(value));
  return rules;
}

Json set_or_varied() {
  Json rules = Json::array();
  for (const Parameter& parameter : parameters()) {
    if (is_group(parameter.path)) continue;
    const Json has = {{"required", {parameter.path}}};
    rules.push_back(
        not_both(with("set", in_any_way(parameter.path)),
                 {{"anyOf", {with("grid", has), with("zip", has), with("random", has)}}}));
  }
  return rules;
}

Json rules_of_the_whole() {
  const auto with_base = [](const char* path) { return with("base", in_any_way(path)); };
  const Json several = with("replicates", {{"minimum", 2}});
  const Json blocks_fill = with_block_about("^fill(\\.|$)");
  const Json blocks_count = with("sweep", {{"contains", {{"required", {"replicates"}}}}});
  return Json::array(
      {not_all({with_base("fill.diameter"), no(with_base("fill.file")), no(with_base("fill.files")),
                no(blocks_fill)}),
       not_all({with_base("fill.file"), several, no(blocks_fill), no(blocks_count)}),
       not_all({with_base("shape.mixture_by"), no(with_base("shape.mixture")),
                no(with_block_about("^shape(\\.|$)"))}),
       not_all({with_base("sizes.distribution"), no(with("base", has_size_formula())),
                no(with_block_about("^sizes(\\.|$)"))})});
}

}  // namespace grainsweep
