#include <sstream>
#include <string>
#include <vector>

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

/// The same of its one family.
Published value_of_family(const std::string& members) {
  return reference_of(R"({"source": "S", "families": [{"where": {}, "values": [{)" + members +
                      "}]}]}")
      .families.at(0)
      .values.at(0);
}

TEST_CASE("values, ranges, errors and words are read and printed as they were published") {
  const Published z = value_of(R"("quantity": "Z_unconfined", "value": 6.027, "error": 0.012)");
  CHECK(z.quantity == "Z_unconfined");
  CHECK(z.range->low == 6.027);
  CHECK(z.range->high == 6.027);
  CHECK(z.range->error == 0.012);
  CHECK(z.text == "6.027 ± 0.012");
  CHECK(value_of(R"("quantity": "Z_unconfined", "value": 6, "error": 0)").text == "6");
  const Published relative =
      value_of(R"("quantity": "Z_unconfined", "value": [4, 6], "relative_error": 0.02)");
  CHECK(relative.range->error == 0.1);
  const Published product =
      value_of(R"("quantity": "Z", "width": 8, "value": 7, "relative_error": 0.1)");
  CHECK(product.range->error == 0.7);  // not 0.7000000000000001
  CHECK(product.text == "7 ± 0.7");
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

/// What is wrong with a file r.json of this text, line by line without its folder.
std::vector<std::string> told_of(const std::string& text) {
  std::vector<std::string> lines;
  try {
    reference_of(text);
  } catch (const BadInput& error) {
    std::istringstream told(error.what());
    for (std::string line; std::getline(told, line);) {
      lines.push_back(line.substr(line.find("/r.json") + 1));
    }
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST_CASE("texts are printed on one line, without what a terminal would obey") {
  const Published z = value_of(
      R"("quantity": "Z_unconfined", "value": 6, "text": "a\u001bb\nc", "definition": "\u009bd")");
  CHECK(z.text == "a b c");
  CHECK(z.definition == "?d");
}

TEST_CASE("what no packing can be is refused where families are told apart") {
  const auto told = [](const std::string& where) {
    return told_of(R"({"source": "S", "families": [{"values": [], "where": {)" + where + "}}]}");
  };
  const std::string place = "r.json:1:55 /families/0/where/";
  CHECK(told(R"("shpe": "sphere")") ==
        Lines{place + R"(shpe: unknown key "shpe"; did you mean "shape"?)"});
  CHECK(told(R"("sizes.small_shar": 0)") ==
        Lines{place + "sizes.small_shar: unknown key \"sizes.small_shar\"; did you mean "
                      "\"sizes.small_share\"?"});
  CHECK(told(R"("shape.cylinder.heigth": 2)") ==
        Lines{place + "shape.cylinder.heigth: unknown key \"shape.cylinder.heigth\"; did you mean "
                      "\"shape.cylinder.height\"?"});
  CHECK(told(R"("small_share": 0)") ==
        Lines{place +
              R"(small_share: unknown key "small_share"; did you mean "sizes.small_share"?)"});
  CHECK(told(R"("label": "tubes")") ==
        Lines{place + "label: unknown key \"label\"; known here: accuracy, shape, and all other "
                      "parameters by their dotted names"});
  CHECK(told(R"("seed": 8)") ==
        Lines{place + "seed: families are not told apart by their seed; leave it out"});
  const auto value_of = [&](const std::string& path, const std::string& value) {
    const Lines lines = told("\"" + path + "\": " + value);
    const std::string at =
        "r.json:1:" + std::to_string(55 + path.size() + 4) + " /families/0/where/" + path + ": ";
    CHECK(lines.size() == 1);
    return lines.empty() || !lines.front().starts_with(at) ? "" : lines.front().substr(at.size());
  };
  CHECK(
      value_of("shape", "\"spher\"") ==
      "must be \"sphere\", \"pinacoid\", \"cube\", \"cuboid\", \"tetrahedron\", \"octahedron\", "
      "\"dodecahedron\", \"icosahedron\", \"prism\", \"cylinder\", \"hull\" or \"mixture\", is the "
      "text \"spher\"; did you mean \"sphere\"?");
  CHECK(value_of("accuracy", "\"medium\"") ==
        "must be \"fast\", \"balanced\", \"accurate\", \"exact\" or \"custom\", is the text "
        "\"medium\"");
  CHECK(value_of("box.y", "\"wals\"") ==
        "must be \"periodic\" or \"walls\", is the text \"wals\"; did you mean \"walls\"?");
  CHECK(value_of("box.length", "\"4\"") == "must be a number, is the text \"4\"");
  CHECK(value_of("sizes.spread", "3") == "must lie in [0, 0.2], is 3; divide percentages by 100");
  CHECK(value_of("measure.gap_tolerances.0", "1") == "must lie in (0, 0.1), is 1");
  const std::string by_parts = "give each part by its dotted name, as \"sizes.small_share\"";
  CHECK(value_of("sizes", R"({"small_share": 0})") == by_parts);
  CHECK(value_of("shape.cylinder", "2") == by_parts);
  CHECK(value_of("measure.gap_tolerances", "[1e-4]") ==
        "give each number by its place in the list, as \"measure.gap_tolerances.0\"");
  CHECK(told(R"("shape": "mixture", "accuracy.preset": "fast", "measure.gap_tolerances.0": 1e-4,
                "shape.pinacoid.height": 1, "box.y": "walls", "shape.mixture.0.share": 0.5,
                "shape.hull.vertices": "0123456789abcdef")")
            .empty());
  CHECK(told(R"("shape": "hull")").empty());
}

TEST_CASE("all that is wrong in a file of published values is told, each with its place") {
  const auto told_of_value = [](const std::string& members) {
    return told_of(R"({"source": "S", "common": [{)" + members + "}]}");
  };
  CHECK(told_of("{") == Lines{"r.json:1:2: the file ends too early: a bracket or a quote is not "
                              "closed"});
  CHECK(told_of("5") == Lines{"r.json:1:1: must be an object, is 5"});
  CHECK(told_of("{}") ==
        Lines{"r.json:1:1: needs \"source\", where the values are from",
              "r.json:1:1: needs \"families\" or \"common\", lists of published values"});
  CHECK(told_of(R"({"source": 7, "families": {}, "famlies": []})") ==
        Lines{"r.json:1:12 /source: must be a text, is 7",
              "r.json:1:27 /families: must be a list, is an object",
              "r.json:1:31 /famlies: unknown key \"famlies\"; did you mean \"families\"?"});
  CHECK(told_of("{\"source\": \"S\", \"families\": [5,\n {\"where\": null}]}") ==
        Lines{"r.json:1:30 /families/0: must be an object, is 5",
              "r.json:2:2 /families/1: needs \"where\", an object with what the parameters of the "
              "family are"});
  CHECK(told_of_value(R"("quantity": "Z", "width": 5, "width": 4)") ==
        Lines{"r.json:1:58 /common/0/width: the same key is already written at 1:46; keep one of "
              "them"});
  CHECK(told_of_value(R"("quantity": "Z", "width": "6", "value": "1", "eror": 1)") ==
        Lines{"r.json:1:55 /common/0/width: must be a number, is the text \"6\"",
              "r.json:1:69 /common/0/value: must be a number or a range [low, high], is the text "
              "\"1\"",
              "r.json:1:74 /common/0/eror: unknown key \"eror\"; did you mean \"error\"?"});
  CHECK(told_of_value(R"("quantity": "C", "value": 1, "error": "1", "text": 1)") ==
        Lines{"r.json:1:67 /common/0/error: must be a number, is the text \"1\"",
              "r.json:1:80 /common/0/text: must be a text, is 1"});
  CHECK(told_of_value(R"("quantity": "C", "value": [1], "error": -1)") ==
        Lines{"r.json:1:55 /common/0/value: must be a number or a range [low, high], is [1]",
              "r.json:1:69 /common/0/error: must not be negative, is -1"});
  CHECK(told_of_value(R"("quantity": "porosity_bulk", "value": [36, 38])") ==
        Lines{"r.json:1:67 /common/0/value: a share of the volume lies in [0, 1]; divide "
              "percentages by 100, is 36 to 38"});
  CHECK(told_of_value(R"("quantity": "C", "value": [2, 1], "definition": [])") ==
        Lines{"r.json:1:55 /common/0/value: a range must be [low, high], is [2,1]",
              "r.json:1:77 /common/0/definition: must be a text, is an empty list"});
  CHECK(told_of_value(R"("quantity": 5)") ==
        Lines{"r.json:1:41 /common/0/quantity: must be a text, is 5"});
  CHECK(told_of_value(R"("value": 5)") ==
        Lines{"r.json:1:28 /common/0: needs \"quantity\", its name"});
  CHECK(told_of_value(R"("quantity": "Phi", "width": 5)") ==
        Lines{"r.json:1:41 /common/0/quantity: unknown quantity \"Phi\"; did you mean \"phi\"?"});
  CHECK(told_of_value(R"("quantity": "phi")") ==
        Lines{"r.json:1:41 /common/0/quantity: phi needs a \"width\""});
}

TEST_CASE("a formula stands in place of the values at single widths") {
  const auto read = [](const std::string& members) {
    return value_of_family(R"("quantity": "phi", )" + members);
  };
  const Published whole = read(R"("formula": "0.64 - 0.2/W", "from": 4, "to": 20, "error": 0.01)");
  CHECK(whole.text == "0.64 - 0.2/W ± 0.01");
  CHECK(whole.formula->text == "0.64 - 0.2/W");
  CHECK(whole.formula->from == 4.0);
  CHECK(whole.formula->to == 20.0);
  CHECK(whole.formula->error.own == 0.01);
  CHECK(whole.formula->name == "0.64 - 0.2/W");
  CHECK_FALSE(whole.range);
  const Published open = read(R"("formula": "0.64 - 0.2/W", "text": "a line")");
  CHECK(open.text == "a line: 0.64 - 0.2/W");
  CHECK(open.formula->name == "a line");
  CHECK(open.formula->from == 0.0);
  CHECK(open.formula->to > 1e300);
  CHECK(open.formula->error.own == 0.0);
  const Published relative = read(R"("formula": "1/W", "relative_error": 0.05)");
  CHECK(relative.text == "1/W ± 5 %");
  CHECK(relative.formula->error.relative == 0.05);
  CHECK(relative.formula->error.own == 0.0);
  CHECK(read(R"("formula": "1/W", "relative_error": 0.07)").text == "1/W ± 7 %");
  CHECK(read(R"("formula": "W", "text": "two\nlines")").formula->name == "two lines");
  CHECK(read(R"("formula": "W", "text": "")").text == "W");
}

TEST_CASE("a profile is a list of points over the distance from the wall") {
  const auto read = [](const std::string& members) {
    return value_of_family(R"("quantity": "porosity", )" + members);
  };
  const Published published = read(
      R"("width": 7, "profile": [[0.5, 0.3], [0, 1], [1, 0.4]], "relative_error": 0.1, "text": "M")");
  CHECK(published.text == "M: 3 points from 0 to 1 d ± 10 %");
  CHECK(published.width == 7);
  CHECK(published.profile->name == "M");
  CHECK(published.profile->error.relative == 0.1);
  REQUIRE(published.profile->points.size() == 3);
  CHECK(published.profile->points[1].distance == 0.5);
  CHECK(published.profile->points[1].value == 0.3);
  CHECK(read(R"("width": 7, "profile": [[0.5, 0.3]])").text == "1 point from 0.5 to 0.5 d");
  const auto told = [](const std::string& members) {
    Lines lines =
        told_of(R"({"source": "S", "families": [{"where": {}, "values": [{)" + members + "}]}]}");
    for (std::string& line : lines) line.erase(0, line.find(" /families/0/values/0/") + 22);
    return lines;
  };
  const std::string of_phi = R"("quantity": "phi", "width": 7, "profile": )";
  CHECK(told(of_phi + "[]") ==
        Lines{"profile: must be a list of points [distance from the wall in d, value], or a "
              "formula over y, that distance, is an empty list"});
  CHECK(told(of_phi + "[[0, 0.5], [1]]") ==
        Lines{"profile/1: must be a point [distance from the wall in d, value], is [1]"});
  CHECK(told(of_phi + "[[-1, 0.5]]").size() == 1);
  CHECK(told(of_phi + "[[1, 50]]") ==
        Lines{"profile/0: a share of the volume lies in [0, 1]; divide percentages by 100, is 50"});
  CHECK(told(of_phi + R"([[1, 0.5]], "value": 0.5)") ==
        Lines{"value: a profile is given, too; keep one of them"});
  CHECK(told(R"("quantity": "reach", "width": 7, "profile": [[1, 0.5]])") ==
        Lines{"quantity: profiles are of phi, porosity or Z, is reach"});
  CHECK(told(R"("quantity": "phi", "profile": [[1, 0.5]])") ==
        Lines{"quantity: phi needs a \"width\""});
  CHECK(
      told_of(
          R"({"source": "S", "common": [{"quantity": "phi", "width": 7, "profile": [[1, 0.5]]}]})") ==
      Lines{"r.json:1:60 /common/0/profile: profiles belong to \"families\"; { } as \"where\" "
            "means all of them"});
}

TEST_CASE("a profile may be a formula over the distance from the wall, of which points are taken") {
  const auto read = [](const std::string& members) {
    return value_of_family(R"("quantity": "porosity", )" + members);
  };
  const Published line = read(R"("width": 4, "profile": "1 - y/D", "text": "line", "error": 0.01)");
  CHECK(line.text == "line: 1 - y/D ± 0.01");
  CHECK(line.profile->formula == "1 - y/D");
  const auto points = points_at(4, line);
  REQUIRE(points.size() == 40);  // every 0.05 d, up to the axis
  CHECK(points.front().distance == 0.05);
  CHECK(points.front().value == Approx(1 - 0.05 / 4));
  CHECK(points.back().distance == 2);
  CHECK(points.back().value == Approx(0.5));
  CHECK(points_at(4, read(R"("profile": "1.5 - y")")).size() == 21);  // 0.5 to 1.5 d
  const auto told = [](const std::string& profile) {
    const Lines lines = told_of(
        R"({"source": "S", "families": [{"where": {}, "values": [{"quantity": "phi", "width": 4, )"
        R"("profile": ")" +
        profile + "\"}]}]}");
    return lines.empty() ? "" : lines.front().substr(lines.front().find("/profile: ") + 10);
  };
  CHECK(told("J0(y)*J0(-y)").empty());
  CHECK(told("1 - D") == "a profile has y, the distance from the wall");
  CHECK(told("y/D + y/W") ==
        "a profile has either W, the gap between walls, or D, the diameter of a tube");
  CHECK_THAT(told("x"), Catch::StartsWith("unknown name \"x\"; known are y, the distance from the "
                                          "wall; W, the gap"));
}

TEST_CASE("an error is given as itself or as a share of the value, not as both") {
  const std::string at = "r.json:1:", place = " /common/0/relative_error";
  const auto told = [](const std::string& members) {
    return told_of(R"({"source": "S", "common": [{"quantity": "C", "value": 1, )" + members +
                   "}]}");
  };
  CHECK(told(R"("error": 0.1, "relative_error": 0.1)") ==
        Lines{at + "72" + place + ": \"error\" is given, too; keep one of them"});
  CHECK(told(R"("relative_error": 5)") ==
        Lines{at + "76" + place + ": must be a share of the value, below 1 (0.05 for 5 %), is 5"});
}

TEST_CASE("what cannot be said of a formula is told with its place") {
  const auto told = [](const std::string& members) {
    return told_of(R"({"source": "S", "families": [{"where": {}, "values": [{)" + members +
                   "}]}]}");
  };
  const std::string at = "r.json:1:", value = " /families/0/values/0";
  CHECK(told(R"("quantity": "phi", "formula": 0.6)") ==
        Lines{at + "86" + value + "/formula: must be a text, is 0.6"});
  CHECK(told(R"("quantity": "phi", "formula": "W/0+")").size() == 1);
  const std::string every =
      ": a formula gives the value at every width; leave this out, or the formula";
  CHECK(told(R"("quantity": "phi", "width": 5, "value": 0.6, "formula": "W")") ==
        Lines{at + "75" + value + "/width" + every, at + "87" + value + "/value" + every});
  CHECK(told(R"("quantity": "phi", "width": 5, "from": 3)") ==
        Lines{at + "87" + value + "/from: belongs to a \"formula\", and there is none"});
  CHECK(told(R"("quantity": "phi", "formula": "W", "from": 5, "to": 4)") ==
        Lines{at + "99" + value + "/from: must not be above \"to\", is 5"});
  CHECK(told(R"("quantity": "C", "formula": "W")") ==
        Lines{at + "68" + value +
              "/quantity: C is one value of a family, not one of each width: give "
              "a value"});
  CHECK(told_of(R"({"source": "S", "common": [{"quantity": "phi", "formula": "W"}]})") ==
        Lines{"r.json:1:48 /common/0/formula: formulas belong to \"families\"; { } as \"where\" "
              "means all of them"});
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
  return describes(reference_of(R"({"source": "S", "families": [{"where": )" + where + "}]}")
                       .families.at(0)
                       .where,
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
