#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <regex>
#include <string>

#include <catch2/catch.hpp>

#include "runner/sweep/json_text.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/sweep/schema.hpp"
#include "tests/runner/sweep/sweep_files.hpp"
#include "tests/support/tries.hpp"

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

/// What a rule says under a key; null if it says nothing.
const Json& part(const Json& rule, const char* key) {
  static const Json nothing;
  const auto at = rule.find(key);
  return at == rule.end() ? nothing : *at;
}

/// Whether there is no such rule, or the value fits it.
bool fits_if_any(const Json& rule, const Json& value) {
  return rule.is_null() || fits(rule, value);
}

bool fits_members(const Json& rule, const Json& object) {
  for (const Json& key : part(rule, "required")) {
    if (!object.contains(key.get<std::string>())) return false;
  }
  const Json &known = part(rule, "properties"), &others = part(rule, "additionalProperties"),
             &names = part(rule, "propertyNames");
  for (const auto& [key, value] : object.items()) {
    const bool is_known = known.is_object() && known.contains(key);
    if (!fits_if_any(names, key) || !fits_if_any(is_known ? known.at(key) : others, value)) {
      return false;
    }
  }
  return object.size() >= rule.value("minProperties", 0u) &&
         object.size() <= rule.value("maxProperties", 1u << 20);
}

/// One for all, or a list of them; what is beyond that is free.
const Json& rule_of_entry(const Json& rule, std::size_t number) {
  static const Json nothing;
  const Json& items = part(rule, "items");
  if (!items.is_array()) return items;
  return number < items.size() ? items[number] : nothing;
}

bool is_set(const Json& list) {
  for (auto entry = list.begin(); entry != list.end(); ++entry) {
    if (std::find(list.begin(), entry, *entry) != entry) return false;
  }
  return true;
}

bool fits_entries(const Json& rule, const Json& list) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!fits_if_any(rule_of_entry(rule, i), list[i])) return false;
  }
  if (rule.value("uniqueItems", false) && !is_set(list)) return false;
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
  static std::map<std::string, std::regex> compiled;
  const auto pattern = rule.value("pattern", std::string());
  return text.size() >= rule.value("minLength", 0u) &&
         text.size() <= rule.value("maxLength", 1000u) &&
         std::regex_search(text, compiled.try_emplace(pattern, pattern).first->second);
}

bool fits_parts(const Json& rule, const Json& value) {
  const auto one = [&](const Json& rule_of_it) { return fits(rule_of_it, value); };
  const Json &any = part(rule, "anyOf"), &all = part(rule, "allOf"), &no = part(rule, "not");
  return (any.is_null() || std::any_of(any.begin(), any.end(), one)) &&
         std::all_of(all.begin(), all.end(), one) && (no.is_null() || !fits(no, value));
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
       R"("base": {"shape": "cube"})",
       R"("base": {"shape": {"cylinder": {"height": 2, "chord_error": 0.02}}})",
       R"("base": {"shape": {"prism": {"sides": 5}, "prism.height": 2}, "shape.prism.diameter": 1.2})",
       R"("sweep": [{"grid": {"shape": ["cube", "octahedron", {"cuboid": {"height": 0.5}}]}}])",
       R"("base": {"shape": {"hull": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "size": 1}}})",
       R"("sweep": [{"grid": {"shape.pinacoid.angle_deg": [50, 60]}}])",
       R"("sweep": [{"grid": {"shape": ["sphere", {"pinacoid": {"angle_deg": 50}}]}}])",
       R"("sweep": [{"random": {"count": 2, "shape.pinacoid.width": {"uniform": [1, 2]}}}])",
       R"("sweep": [{"random": {"count": 2, "box.width": {"uniform": [5, 9]}}}])",
       R"("sweep": [{"random": {"count": 2, "box.width": {"uniform": [5, 5]}}}])",
       R"("sweep": [{"zip": {"box.width": [6, 6], "box.length": [9, 8]}}])",
       R"("base": {"measure": {"exclude_floor": 20}}, "sweep": [{"set": {"fill.solid_height": 30}}])",
       R"("base": {"box.length": 2.5, "sizes.small_share": 1})",
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
        R"("base": {"shape": "hull"})",
        R"("base": {"shape": {"cubus": {}}})",
        R"("base": {"shape": {"cube": {"edge": 0}}})",
        R"("base": {"shape": {"prism": {"sides": 2}}})",
        R"("base": {"shape": {"cube": {}, "prism": {}}})",
        R"("base": {"shape": "cube", "shape.prism.sides": 5})",
        R"("base": {"shape.cuboid.length": 1, "shape.cylinder": {"height": 2}})",
        R"("base": {"shape": {"pinacoid": {"angle": 60}}})",
        R"("base": {"shape": {"hull": {"vertices": [[0, 0]]}}})",
        R"("base": {"shape": {"hull": {"vertices": [[0,0,2],[1,0,2],[0,0,1],[1,0,1]]}}})",
        R"("base": {"shape": {"hull": {"file": 5}}})",
        R"("base": {"shape.mixture": [{"share": 1, "hull": {"size": 1}}]})",
        R"("base": {"shape.mixture": [{"share": 1, "hull": {"file": "a.obj", "vertices": []}}]})",
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
        R"("sweep": [{"label": "=1+1"}])",
        R"("sweep": [{"label": "-1"}])",
        R"("sweep": [{"label": "a\u007fb"}])",
        R"("sweep": [{"random": {"count": 1, "box.width": {"uniform": [20, 5]}}}])",
        R"("sweep": [{"zip": {"box.width": [6, 6], "box.length": [9, 9]}}])",
        R"("sweep": [{"zip": {"box.width": [6, 7, 6]}}])",
        R"("base": {"box.length": 2.5})",
        R"("base": {"measure": {"exclude_floor": 20}})",
        R"("base": {"measure.exclude_surface": 40, "fill.solid_height": 15})",
        R"("base": {"fill": {"solid_height": 2.5}})",
        R"("base": {"fill.grains": 900})",
        R"("base": {"box": {"length": 240, "width": 240}, "fill": {"solid_height": 100}})",
        R"("base": {"shape": {"pinacoid": {"length": 50}}})",
        R"("base": {"shape": {"hull": {"vertices":
            [[0,0,0],[0.001,0,0],[0,0.001,0],[0,0,0.001]]}}})",
        R"("base": {"shape": "pinacoid", "tube.diameter": 3})",
        R"("base": {"accuracy.step": 0.001}, "sweep": [{"grid": {"box.width": [5, 6]}}])",
        R"("sweep": [{"grid": {"box.width": [5, 5.0]}}])"}) {
    const std::string text = R"({"name": "a", )" + body + "}";
    INFO(text);
    CHECK_FALSE(errors_of(text).empty());
    CHECK_FALSE(fits(text));
  }
}

/// A sweep of spheres or pinacoids that says some of what the edges of what can be packed depend
/// on, each somewhere in its range.
std::string sweep_near_edges(std::mt19937_64& random) {
  const auto share = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const auto is_one_in = [&](int many) { return share() * many < 1.0; };
  const auto drawn = [&](double least, double most) {
    return Json(least * std::pow(most / least, share())).dump();
  };
  const bool is_pinacoid = is_one_in(2), is_tube = is_one_in(4);
  std::vector<std::string> base, varied;
  const auto say = [&](const std::string& group, const std::string& key, int one_in, double least,
                       double most) {
    if (!is_one_in(one_in)) return;
    const std::string path = group + "." + key;
    base.push_back("\"" + path + "\": " + drawn(least, most));
    if (is_one_in(3)) {
      varied.push_back("\"" + path + "\": [" + drawn(least, most) + ", " + drawn(least, most) +
                       "]");
    }
  };
  if (is_pinacoid) {
    base.emplace_back(R"("shape": "pinacoid")");
    say("shape", "pinacoid.length", 2, 0.5, 60.0);
    say("shape", "pinacoid.width", 3, 0.5, 4.0);
    say("shape", "pinacoid.height", 3, 0.5, 4.0);
    say("shape", "pinacoid.angle_deg", 3, 30.0, 80.0);
  }
  if (is_tube) {
    say("tube", "diameter", 1, 2.0, 10.0);
  } else {
    say("box", "length", 2, 2.0, 400.0);
    say("box", "width", 2, 1.0, 400.0);
    if (is_one_in(3)) base.emplace_back(R"("box.x": "walls")");
    if (is_one_in(3)) base.emplace_back(R"("box.y": "walls")");
  }
  say("fill", "solid_height", 2, 1.0, 400.0);
  say("measure", "exclude_floor", 3, 0.5, 200.0);
  say("measure", "exclude_surface", 3, 0.5, 200.0);
  say("accuracy", "step", 3, 5e-4, 0.3);
  say("sizes", "spread", 8, 0.001, 0.1);
  std::string text = R"({"name": "a", "base": {)";
  for (const std::string& said : base) text += (&said == &base[0] ? "" : ", ") + said;
  text += "}";
  if (!varied.empty()) text += R"(, "sweep": [{"grid": {)" + varied[0] + "}}]";
  return text + "}";
}

TEST_CASE("near the edges of what can be packed the schema accepts all that the reader accepts") {
  std::mt19937_64 random(7);
  const ScratchFolder folder;
  int right = 0, refused_by_both = 0, refused = 0;
  constexpr int draws = testing::tries(800);
  for (int draw = 0; draw < draws; ++draw) {
    const std::string text = sweep_near_edges(random);
    const bool is_right = read_sweep(folder.write("s.json", text)).errors.empty();
    const bool does_fit = fits(text);
    if (is_right && !does_fit) FAIL(text);
    right += is_right;
    refused += !is_right;
    refused_by_both += !is_right && !does_fit;
  }
  CHECK(right > draws / 4);
  CHECK(refused > draws / 4);
  CHECK(refused_by_both > draws / 11);
}

TEST_CASE("a name and only texts that can be a folder's are allowed") {
  CHECK_FALSE(fits("{}"));
  CHECK(schema().at("properties").at("name").at("pattern") ==
        "^[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}$");
}

}  // namespace
}  // namespace grainsweep
