#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>
#include <string>

#include <catch2/catch.hpp>

#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/schema.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

const Json& schema() {
  static const Json parsed = Json::parse(sweep_schema());
  return parsed;
}

bool fits(const Json& rule, const Json& value);

bool has_type(const std::string& type, const Json& value) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "number") return value.is_number();
  return value.is_number_integer() ||
         (value.is_number() && value.get<double>() == std::floor(value.get<double>()));
}

bool fits_members(const Json& rule, const Json& object) {
  for (const Json& key : rule.value("required", Json::array())) {
    if (!object.contains(key.get<std::string>())) return false;
  }
  const Json known = rule.value("properties", Json::object());
  const Json others = rule.value("additionalProperties", Json(true));
  const Json names = rule.value("propertyNames", Json::object());
  return std::all_of(object.items().begin(), object.items().end(), [&](const auto& member) {
    return fits(names, member.key()) &&
           fits(known.contains(member.key()) ? known.at(member.key()) : others, member.value());
  });
}

/// One for all, or a list of them; what is beyond that is free.
Json rule_of_entry(const Json& rule, std::size_t number) {
  const Json items = rule.value("items", Json::object());
  if (!items.is_array()) return items;
  return number < items.size() ? items[number] : Json::object();
}

bool fits_entries(const Json& rule, const Json& list) {
  const bool is_set = rule.value("uniqueItems", false);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!fits(rule_of_entry(rule, i), list[i])) return false;
    if (is_set && std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) !=
                      list.begin() + static_cast<std::ptrdiff_t>(i)) {
      return false;
    }
  }
  const auto is_wanted = [&](const Json& entry) { return fits(rule.at("contains"), entry); };
  if (rule.contains("contains") && std::none_of(list.begin(), list.end(), is_wanted)) return false;
  return list.size() >= rule.value("minItems", 0u) &&
         list.size() <= rule.value("maxItems", 1u << 20);
}

bool fits_number(const Json& rule, const Json& value) {
  const auto keeps = [&](const char* bound, auto is_kept) {
    return !rule.contains(bound) || is_kept(value.get<double>(), rule.at(bound).get<double>());
  };
  return keeps("minimum", std::greater_equal<>()) && keeps("maximum", std::less_equal<>()) &&
         keeps("exclusiveMinimum", std::greater<>()) && keeps("exclusiveMaximum", std::less<>());
}

bool fits_text(const Json& rule, const std::string& text) {
  return text.size() >= rule.value("minLength", 0u) &&
         text.size() <= rule.value("maxLength", 1000u) &&
         std::regex_search(text, std::regex(rule.value("pattern", std::string())));
}

bool fits_parts(const Json& rule, const Json& value) {
  const auto one = [&](const Json& part) { return fits(part, value); };
  const Json any = rule.value("anyOf", Json()), all = rule.value("allOf", Json());
  return (any.is_null() || std::any_of(any.begin(), any.end(), one)) &&
         std::all_of(all.begin(), all.end(), one) &&
         !(rule.contains("not") && fits(rule.at("not"), value));
}

/// The part of JSON Schema that the schema of sweeps uses, by the letter of draft 7.
bool fits(const Json& rule, const Json& value) {
  if (rule.is_boolean()) return rule.get<bool>();
  if (rule.contains("$ref")) {
    const std::string prefix = "#/definitions/";
    return fits(
        schema().at("definitions").at(rule.at("$ref").get<std::string>().substr(prefix.size())),
        value);
  }
  if (rule.contains("const") && value != rule.at("const")) return false;
  if (rule.contains("type") && !has_type(rule.at("type"), value)) return false;
  if (!fits_parts(rule, value)) return false;
  if (value.is_number()) return fits_number(rule, value);
  if (value.is_string()) return fits_text(rule, value);
  if (value.is_object()) return fits_members(rule, value);
  return !value.is_array() || fits_entries(rule, value);
}

bool fits(const std::string& text) { return fits(schema(), Json::parse(text)); }

TEST_CASE("the schema has every parameter, with its meaning") {
  for (const Parameter& parameter : parameters()) {
    const Json& definition = schema().at("definitions").at(parameter.path);
    CHECK(definition.at("description") == parameter.meaning);
  }
  const Json& walls = schema().at("definitions").at("box.y").at("anyOf").at(1);
  CHECK(walls.at("const") == "walls");
  CHECK(walls.at("description") == "two flat walls without friction");
  const Json& width = schema().at("definitions").at("box.width");
  CHECK(width.at("type") == "number");
  CHECK(width.at("minimum") == 1.0);
  CHECK(width.at("maximum") == 10000.0);
}

/// Whether everything that can be written has a description, but for entries of lists.
bool is_described(const Json& rule) {
  const Json members = rule.value("properties", Json::object());
  return std::all_of(members.begin(), members.end(), [](const Json& member) {
    if (member.contains("$ref")) {
      const auto target = member.at("$ref").get<std::string>().substr(14);
      return schema().at("definitions").at(target).contains("description");
    }
    return member.contains("description") && is_described(member);
  });
}

TEST_CASE("the schema describes every key, group, list and name") {
  CHECK(is_described(schema()));
  const Json& block = schema().at("properties").at("sweep").at("items");
  CHECK(is_described(block));
  for (const Parameter& parameter : parameters()) {
    CHECK(parameter.choice_meanings.size() == parameter.choices.size());
  }
}

TEST_CASE("what the reader takes fits the schema") {
  for (
      const std::string body :
      {R"("base": {"box": {"width": 5}, "accuracy": "fast"})",
       R"("seed": 18446744073709551615)",
       R"("replicates": 10000)",
       R"("$schema": "sweep.schema.json")",
       R"("units": {"d": 3.2, "unit": "mm", "density": 2500})",
       R"("units": {"d": 450, "unit": "um"})",
       R"("base": {"accuracy": {"preset": "fast", "solver": "pgs"}, "box.y": "walls"})",
       R"("sweep": [{"label": "a", "grid": {"box.width": [5, 6], "accuracy": ["fast"]}}])",
       R"("sweep": [{"zip": {"box.width": [5, 6], "seed": [1, 2]}, "replicates": 2}])",
       R"("sweep": [{"set": {"measure.gap_tolerances": [1e-4], "fill": {"grains": 4000}}}])",
       R"("base": {"shape": "pinacoid"})",
       R"("base": {"shape": {"pinacoid": {}}})",
       R"("base": {"shape.pinacoid": {"width": 1.5}})",
       R"("base": {"shape": {"pinacoid.width": 1.5}})",
       R"("base": {"shape": {"hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 1}}})",
       R"("sweep": [{"grid": {"shape.pinacoid.angle_deg": [50, 60]}}])",
       R"("sweep": [{"grid": {"shape": ["sphere", {"pinacoid": {"angle_deg": 50}}]}}])",
       R"("sweep": [{"random": {"count": 2, "shape.pinacoid.width": {"uniform": [1, 2]}}}])",
       R"("sweep": [{"random": {"count": 2, "box.width": {"uniform": [5, 9]}}}])",
       R"("sweep": [{"random": {"count": 2, "accuracy": {"choice": ["fast", "accurate"]}}}])"}) {
    const std::string text = R"({"name": "a", )" + body + "}";
    INFO(text);
    CHECK(errors_of(text).empty());
    CHECK(fits(text));
  }
}

TEST_CASE("what does not fit the schema the reader refuses") {
  for (const std::string body :
       {R"("sede": 1)",
        R"("seed": -1)",
        R"("replicates": 0)",
        R"("replicates": 1.5)",
        R"("$schema": 7)",
        R"("units": "mm")",
        R"("units": {"d": 3.2})",
        R"("units": {"d": 0, "unit": "mm"})",
        R"("units": {"d": 3.2, "unit": "inch"})",
        R"("units": {"d": 3.2, "unit": "mm", "density": 2.5})",
        R"("units": {"d": 3.2, "unit": "mm", "mass": 2500})",
        R"("base": [])",
        R"("base": {"seed": 1})",
        R"("base": {"bx": {}})",
        R"("base": {"box": {"lenght": 5}})",
        R"("base": {"box": {"width": "5"}})",
        R"("base": {"box.y": "wall"})",
        R"("base": {"accuracy": "quick"})",
        R"("base": {"shape": "cube"})",
        R"("base": {"shape": {"cube": {}}})",
        R"("base": {"shape": {"pinacoid": {"angle": 60}}})",
        R"("base": {"shape": {"hull": {"vertices": [[0, 0]]}}})",
        R"("base": {"shape": {"hull": {"vertices": [[0,0,2],[1,0,2],[0,0,1],[1,0,1]]}}})",
        R"("base": {"shape": {"hull": {"file": 5}}})",
        R"("base": {"accuracy": {"solver": "gs"}})",
        R"("base": {"fill": {"grains": 1.5}})",
        R"("sweep": [])",
        R"("sweep": [{"gird": {}}])",
        R"("sweep": [{"grid": {"box.width": 5}}])",
        R"("sweep": [{"grid": {"box.width": []}}])",
        R"("sweep": [{"zip": {"width": [1]}}])",
        R"("sweep": [{"random": {"box.width": {"uniform": [5, 9]}}}])",
        R"("sweep": [{"random": {"count": 1, "box.width": {"uniform": [5]}}}])",
        R"("sweep": [{"random": {"count": 1, "box.width": {"normal": [5, 6]}}}])",
        R"("sweep": [{"random": {"count": 1, "box.y": {"uniform": [5, 6]}}}])",
        R"("sweep": [{"random": {"count": 1, "box.width": {"uniform": [0.5, 6]}}}])",
        R"("sweep": [{"random": {"count": 1, "sizes.small_share": {"log_uniform": [0, 1]}}}])",
        R"("seed": 1e20)",
        R"("base": {"box.width": -5})",
        R"("base": {"sizes.spread": 0.9})",
        R"("base": {"fill": {"grains": 800, "solid_height": 9.95}})",
        R"("base": {"fill": {"grains": 800}, "fill.solid_height": 9.95})",
        R"("base": {"box": {"width": 5}, "box.width": 6})",
        R"("base": {"shape": {"pinacoid": {"width": 1}}, "shape.pinacoid.width": 1})",
        R"("base": {"shape": {"pinacoid": {}, "hull": {"file": "a.obj"}}})",
        R"("base": {"measure": {"gap_tolerances": []}})",
        R"("base": {"measure": {"gap_tolerances": [0.001, 0.001]}})",
        R"("base": {"fill.diameter": 3})",
        R"("replicates": 3, "base": {"fill": {"file": "a.csv"}})",
        R"("base": {"shape": {"pinacoid": {"angle_deg": 44}}})",
        R"("sweep": [{"set": {"box": {"width": 5}}, "grid": {"box.width": [6, 7]}}])",
        R"("sweep": [{"zip": {"box.width": [6, 7], "box.length": [6, 7, 8]}}])",
        R"("sweep": [{"label": ""}])",
        R"("sweep": [{"grid": {"box.width": [5, 5.0]}}])"}) {
    const std::string text = R"({"name": "a", )" + body + "}";
    INFO(text);
    CHECK_FALSE(errors_of(text).empty());
    CHECK_FALSE(fits(text));
  }
}

TEST_CASE("a name and only texts that can be a folder's are allowed") {
  CHECK_FALSE(fits("{}"));
  CHECK(schema().at("properties").at("name").at("pattern") ==
        "^[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}$");
}

}  // namespace
}  // namespace grainsweep
