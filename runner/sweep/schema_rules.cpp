#include "runner/sweep/schema_rules.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "engine/scene/spec.hpp"
#include "engine/shape/shape_spec.hpp"
#include "engine/units.hpp"
#include "runner/sweep/parameters.hpp"

namespace grainsweep {
namespace {

/// That an object holds the member `path`, in each way to write it, "a.b": 1 and "a": {"b": 1},
/// and that `value` holds for it unless that is null.
std::vector<Json> spellings(const std::string& path, const Json& value) {
  std::vector<Json> all = {{{"required", {path}}}};
  if (!value.is_null()) all[0]["properties"] = {{path, value}};
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
    const std::string group = path.substr(0, dot);
    for (Json inside : spellings(path.substr(dot + 1), value)) {
      inside["type"] = "object";
      all.push_back({{"required", {group}}, {"properties", {{group, inside}}}});
    }
  }
  return all;
}

Json not_both(const Json& one, const Json& other) { return {{"not", {{"allOf", {one, other}}}}}; }

Json in_any_way(const std::string& path, const Json& value = nullptr) {
  return {{"anyOf", spellings(path, value)}};
}

Json no(const Json& schema) { return {{"not", schema}}; }

/// That an object has a member that fits.
Json with(const std::string& member, const Json& schema) {
  return {{"required", {member}}, {"properties", {{member, schema}}}};
}

/// That a block fits.
Json with_block(const Json& block) { return with("sweep", {{"contains", block}}); }

/// That an object has a key that matches.
Json with_key(const std::string& pattern) {
  return no({{"propertyNames", no({{"pattern", pattern}})}});
}

/// That a block has one where it says what its packings are.
Json with_block_key(const std::string& pattern) {
  const Json about = with_key(pattern);
  std::vector<Json> ways;
  for (const char* member : {"set", "grid", "zip", "random"}) ways.push_back(with(member, about));
  return with_block({{"anyOf", ways}});
}

/// Any word of these groups, "a|b".
std::string about(const std::string& groups) { return "^(" + groups + ")(\\.|$)"; }

/// That a block says anything of a group.
Json with_block_about(const std::string& group) { return with_block_key(about(group)); }

Json with_base_key(const std::string& pattern) { return with("base", with_key(pattern)); }

Json with_base(const std::string& path, const Json& value = nullptr) {
  return with("base", in_any_way(path, value));
}

Json not_all(const std::vector<Json>& schemas) { return no({{"allOf", schemas}}); }

/// Below it the ends of a pinacoid of usual length and height would cross, degrees.
double least_usual_angle() {
  const PinacoidSize usual;
  return std::atan(usual.height / usual.length) * 180.0 / pi;
}

/// The largest multiple of `unit` at which a packing is refused that is usual in all else; `set`
/// gives it the value.
template <class Set>
double most_refused(double unit, Set set) {
  std::int64_t refused = 0, right = 100'000;
  while (right - refused > 1) {
    const std::int64_t middle = (refused + right) / 2;
    PackingSpec spec;
    set(spec, unit * static_cast<double>(middle));
    (check(spec).empty() ? right : refused) = middle;
  }
  return unit * static_cast<double>(refused);
}

/// That a period holds no two spheres of the usual sizes.
Json too_short_period() {
  const double most = most_refused(1e-3, [](auto& spec, double d) { spec.box.length = d; });
  return not_all({with_base("box.length", {{"maximum", most}}),
                  no(with_base("box.x", {{"const", "walls"}})),
                  no(with_base("shape", no({{"const", "sphere"}}))),
                  no(with_base_key("^shape\\.|" + about("sizes"))), no(with_base("fill.file")),
                  no(with_base("fill.files")),
                  no(with_block_key(about("shape|sizes|fill|tube") + "|^box(\\.length|\\.x|$)"))});
}

/// That a bed of the usual spheres, box and zones is too low to be measured.
Json too_low_bed() {
  const double height =
      most_refused(1e-3, [](auto& spec, double d) { spec.fill = SolidHeight{d}; });
  const double grains = most_refused(1.0, [](auto& spec, double count) {
    spec.fill = GrainCount{static_cast<std::int64_t>(count)};
  });
  return not_all({{{"anyOf",
                    {with_base("fill.solid_height", {{"maximum", height}}),
                     with_base("fill.grains", {{"maximum", grains}})}}},
                  no(with_base_key(about("shape|sizes|box|tube|measure"))),
                  no(with_block_key(about("shape|sizes|box|tube|measure|fill")))});
}

}  // namespace

Json said_once(const std::string& group) {
  static const std::vector<std::pair<std::string, std::string>> alternatives = [] {
    std::vector<std::pair<std::string, std::string>> pairs = {
        {"shape.hull.vertices", "shape.hull.file"},
        {"shape.pinacoid", "shape.hull"},
        {"box", "tube"}};
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
  for (const auto& [one, other] : alternatives) {
    if (!is_inside(one) || !is_inside(other)) continue;
    rules.push_back(not_both(in_any_way(inside(one)), in_any_way(inside(other))));
  }
  for (const Parameter& parameter : parameters()) {
    if (!is_inside(parameter.path)) continue;
    const std::vector<Json> ways = spellings(inside(parameter.path), nullptr);
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

Json sweep_rules() {
  const Json several = with("replicates", {{"minimum", 2}});
  return Json::array(
      {not_all({with_base("fill.diameter"), no(with_base("fill.file")), no(with_base("fill.files")),
                no(with_block_about("fill"))}),
       not_all({with_base("fill.file"), several, no(with_block_about("fill")),
                no(with_block({{"required", {"replicates"}}}))}),
       not_all({with_base("shape.pinacoid.angle_deg", {{"exclusiveMaximum", least_usual_angle()}}),
                no(with_base("shape.pinacoid.length")), no(with_base("shape.pinacoid.height")),
                no(with_block_about("shape"))}),
       too_short_period(), too_low_bed()});
}

}  // namespace grainsweep
