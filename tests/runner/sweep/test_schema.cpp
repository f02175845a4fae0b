#include <algorithm>
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
  return value.is_number_integer();
}

bool fits_members(const Json& rule, const Json& object) {
  for (const Json& key : rule.value("required", Json::array())) {
    if (!object.contains(key.get<std::string>())) return false;
  }
  return std::all_of(object.items().begin(), object.items().end(), [&](const auto& member) {
    const Json& known = rule.at("properties");
    return known.contains(member.key()) && fits(known.at(member.key()), member.value());
  });
}

bool fits_entries(const Json& rule, const Json& list) {
  return list.size() >= rule.value("minItems", 0u) &&
         list.size() <= rule.value("maxItems", 1u << 20) &&
         std::all_of(list.begin(), list.end(),
                     [&](const Json& entry) { return fits(rule.at("items"), entry); });
}

bool fits_bounds(const Json& rule, const Json& value) {
  return !value.is_number() ||
         (value >= rule.value("minimum", value) && value <= rule.value("maximum", value));
}

/// The part of JSON Schema that the schema of sweeps uses, by the letter of draft 7.
bool fits(const Json& rule, const Json& value) {
  if (rule.contains("$ref")) {
    const std::string prefix = "#/definitions/";
    return fits(
        schema().at("definitions").at(rule.at("$ref").get<std::string>().substr(prefix.size())),
        value);
  }
  if (rule.contains("anyOf")) {
    const Json& any = rule.at("anyOf");
    return std::any_of(any.begin(), any.end(), [&](const Json& one) { return fits(one, value); });
  }
  if (rule.contains("enum")) {
    const Json& names = rule.at("enum");
    return std::find(names.begin(), names.end(), value) != names.end();
  }
  if (!has_type(rule.at("type"), value) || !fits_bounds(rule, value)) return false;
  if (value.is_object()) return fits_members(rule, value);
  return !value.is_array() || fits_entries(rule, value);
}

bool fits(const std::string& text) { return fits(schema(), Json::parse(text)); }

TEST_CASE("the schema has every parameter, with its meaning") {
  for (const Parameter& parameter : parameters()) {
    const Json& definition = schema().at("definitions").at(parameter.path);
    CHECK(definition.at("description") == parameter.meaning);
  }
  CHECK(schema().at("definitions").at("box.y").at("enum") == Json{"periodic", "walls"});
  CHECK(schema().at("definitions").at("box.width").at("type") == "number");
}

TEST_CASE("what the reader takes fits the schema") {
  for (
      const std::string body :
      {R"("base": {"box": {"width": 5}, "accuracy": "fast"})", R"("seed": 18446744073709551615)",
       R"("replicates": 10000)", R"("$schema": "sweep.schema.json")",
       R"("base": {"accuracy": {"preset": "fast", "solver": "pgs"}, "box.y": "walls"})",
       R"("sweep": [{"label": "a", "grid": {"box.width": [5, 6], "accuracy": ["fast"]}}])",
       R"("sweep": [{"zip": {"box.width": [5, 6], "seed": [1, 2]}, "replicates": 2}])",
       R"("sweep": [{"set": {"measure.gap_tolerances": [1e-4], "fill": {"grains": 400}}}])",
       R"("base": {"shape": "pinacoid"})", R"("base": {"shape": {"pinacoid": {}}})",
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
        R"("sweep": [{"random": {"count": 1, "box.y": {"uniform": [5, 6]}}}])"}) {
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
