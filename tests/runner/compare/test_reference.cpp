#include <catch2/catch.hpp>

#include "runner/compare/reference.hpp"
#include "runner/exit_codes.hpp"
#include "runner/store/files.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep {
namespace {

Reference reference_of(const std::string& text) {
  const TemporaryFolder folder;
  replace_file(folder.path() + "/r.json", text);
  return read_reference(folder.path() + "/r.json");
}

/// The one value of a reference that has no other.
Published value_of(const std::string& members) {
  return reference_of(R"({"source": "S", "common": [{)" + members + "}]}").common.at(0);
}

TEST_CASE("values, ranges, errors and words are read and printed as they were published") {
  const Published z = value_of(R"("quantity": "Z_unconfined", "value": 6.027, "error": 0.012)");
  CHECK(z.quantity == "Z_unconfined");
  CHECK(z.range->low == 6.027);
  CHECK(z.range->high == 6.027);
  CHECK(z.range->error == 0.012);
  CHECK(z.text == "6.027 ± 0.012");
  const Published reach =
      value_of(R"("quantity": "reach", "width": 10, "value": [3, 4], "definition": "by eye")");
  CHECK(reach.range->low == 3);
  CHECK(reach.range->high == 4);
  CHECK(reach.width == 10);
  CHECK(reach.text == "3 to 4");
  CHECK(reach.definition == "by eye");
  const Published about = value_of(R"("quantity": "C", "value": 0.2, "text": "about 0.2")");
  CHECK(about.text == "about 0.2");
  const Published words = value_of(R"("quantity": "C", "text": "falls")");
  CHECK_FALSE(words.range);
  CHECK(value_of(R"("quantity": "C")").text == "-");
}

TEST_CASE("what no packing can be is refused where families are told apart") {
  const auto told = [](const std::string& where) -> std::string {
    try {
      reference_of(R"({"source": "S", "families": [{"where": {)" + where + R"(}, "values": []}]})");
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(told(R"("shpe": "sphere")"),
             Catch::Contains("/families/0: /where/shpe: ") && Catch::Contains("mean \"shape\""));
  CHECK_THAT(told(R"("shape": "spher")"), Catch::Contains("did you mean \"sphere\"?"));
  CHECK_THAT(told(R"("sizes.small_shar": 0)"), Catch::Contains("mean \"sizes.small_share\""));
  CHECK_THAT(told(R"("sizes": {"small_share": 0})"), Catch::Contains("by its dotted name"));
  CHECK_THAT(told(R"("box.length": "4")"), Catch::Contains("must be a number, is \"4\""));
  CHECK_THAT(told(R"("box.y": "wals")"), Catch::Contains("did you mean \"walls\"?"));
  CHECK_THAT(told(R"("accuracy": "medium")"), Catch::Contains("not one of: custom, fast"));
  CHECK_THAT(told(R"("seed": 8)"), Catch::Contains("not told apart by their seed"));
  CHECK(told(R"("shape": "mixture", "accuracy.preset": "fast", "measure.gap_tolerances.0": 1e-4,
                "shape.pinacoid.height": 1, "box.y": "walls")")
            .empty());
}

TEST_CASE("what is wrong in a file of published values is told with its place") {
  const auto told = [](const std::string& text) -> std::string {
    try {
      reference_of(text);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  const auto told_of = [&](const std::string& members) {
    return told(R"({"source": "S", "families": [{"where": {}, "values": [{)" + members + "}]}]}");
  };
  CHECK_THAT(told("{"), Catch::Contains("r.json") && Catch::Contains("parse error"));
  CHECK_THAT(told("{}"), Catch::Contains("needs \"source\""));
  CHECK_THAT(told(R"({"source": "S"})"), Catch::Contains("needs \"families\" or \"common\""));
  CHECK_THAT(told(R"({"source": "S", "families": {}})"), Catch::Contains("must be a list, is {}"));
  CHECK_THAT(told(R"({"source": "S", "families": [5]})"),
             Catch::Contains("/families/0: must be an object, is 5"));
  CHECK_THAT(told(R"({"source": "S", "families": [{"where": null}]})"),
             Catch::Contains("needs \"where\""));
  CHECK_THAT(told(R"({"source": "S", "famlies": []})"), Catch::Contains("\"families\"?"));
  CHECK_THAT(told_of(R"("quantity": "zet")"), Catch::Contains("/families/0: /values/0: unknown"));
  CHECK_THAT(told_of(R"("quantity": "C", "eror": 1)"), Catch::Contains("did you mean \"error\""));
  CHECK_THAT(told_of(R"("quantity": "C", "value": "1")"), Catch::Contains("a number or a range"));
  CHECK_THAT(told_of(R"("quantity": "C", "value": [1])"), Catch::Contains("a number or a range"));
  CHECK_THAT(told_of(R"("quantity": "C", "value": 1, "error": -1)"),
             Catch::Contains("must not be negative"));
  CHECK_THAT(told_of(R"("quantity": 5)"), !Catch::Contains("json.exception"));
  CHECK_THAT(told_of(R"("value": 5)"), Catch::Contains("needs \"quantity\""));
  CHECK_THAT(told_of(R"("quantity": "C", "value": [2, 1])"), Catch::Contains("[low, high]"));
}

/// The family of a packing with these parameters.
Family family_of(const std::string& parameters, const std::string& shape) {
  Family family;
  family.parameters = parameters;
  family.walled.emplace_back().job = sample_job("a", 5);
  family.walled.front().job.shape = shape;
  return family;
}

bool describes_it(const std::string& where, const Family& family) {
  return describes(
      reference_of(R"({"source": "S", "families": [{"where": )" + where + "}]}").families.at(0),
      family);
}

TEST_CASE("values belong to the families whose parameters are those of `where`") {
  const Family spheres = family_of(sample_parameters(5, Boundary::walls, 0.4), "sphere");
  CHECK(describes_it("{}", spheres));
  CHECK(describes_it(R"({"shape": "sphere", "sizes.small_share": 0.4})", spheres));
  CHECK_FALSE(describes_it(R"({"shape": "sphere", "sizes.small_share": 0.5})", spheres));
  CHECK_FALSE(describes_it(R"({"shape": "pinacoid"})", spheres));
  const Family pinacoids =
      family_of(R"({"shape":{"pinacoid":{"angle_deg":60,"height":1}}})", "pinacoid");
  CHECK(describes_it(R"({"shape.pinacoid.angle_deg": 60.0})", pinacoids));
  CHECK_FALSE(describes_it(R"({"shape.pinacoid.angle_deg": 50})", pinacoids));
  CHECK_FALSE(describes_it(R"({"shape.pinacoid.angle_deg": 60})", spheres));
  CHECK(describes_it(R"({"shape": "pinacoid"})", pinacoids));
  CHECK_FALSE(describes_it(R"({"shape": "sphere"})", pinacoids));
}

TEST_CASE("an accuracy is described by the name of its preset, or of the one that it settles as") {
  Family family = family_of(R"({"accuracy":{"step":0.2}})", "sphere");
  for (const char* const path : {"accuracy", "accuracy.preset"}) {
    const std::string of_path = std::string("{\"") + path + "\": ";
    family.walled.front().job.accuracy = "balanced", family.walled.front().job.settles_as = "";
    CHECK(describes_it(of_path + "\"balanced\"}", family));
    CHECK_FALSE(describes_it(of_path + "\"fast\"}", family));
    family.walled.front().job.accuracy = "custom", family.walled.front().job.settles_as = "fast";
    CHECK(describes_it(of_path + "\"fast\"}", family));
    CHECK(describes_it(of_path + "\"custom\"}", family));
  }
}

TEST_CASE("what packings of a family differ in is told to be no part of `where`") {
  CHECK_THAT(advice_on("box.width"), Catch::Contains("give values their \"width\""));
  CHECK_THAT(advice_on("tube.diameter"), Catch::Contains("give values their \"width\""));
  CHECK_THAT(advice_on("box.y"), Catch::Contains("_unconfined"));
  CHECK(advice_on("box.length").empty());
}

TEST_CASE("published values lie beside their sweep") {
  CHECK(reference_beside("configs/paper.json") == "configs/paper.reference.json");
  CHECK(reference_beside("paper") == "paper.reference.json");
}

}  // namespace
}  // namespace grainsweep
