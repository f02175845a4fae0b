#include <catch2/catch.hpp>

#include "runner/sweep/misplaced_keys.hpp"

namespace grainsweep {
namespace {

/// What is said of the members of an object that knows "set" and "grid".
std::vector<std::string> said_of(const std::string& object) {
  Diagnostics diagnostics;
  const KeysOfPlace place = {.known = {"set", "grid"},
                             .layer = "set",
                             .grid = "grid",
                             .elsewhere = {"base"},
                             .other_place = "at the top"};
  refuse_misplaced_keys(Json::parse(object), "", place, diagnostics);
  std::vector<std::string> said;
  for (const Diagnostic& one : diagnostics) said.push_back(one.message);
  return said;
}

TEST_CASE("a path that leaves out groups is found by the members that it has") {
  CHECK(path_with_members("sizes.lognormal.sigma") == "sizes.distribution.lognormal.sigma");
  CHECK(path_with_members("lognormal.sigma") == "sizes.distribution.lognormal.sigma");
  CHECK(path_with_members("cylinder.height") == "shape.cylinder.height");
  CHECK(path_with_members("lognormal.sizes.sigma").empty());  // in another order
  CHECK(path_with_members("sizes.lognormal.sigmas").empty());
  CHECK(path_with_members("sigma").empty());
}

TEST_CASE("keys of another place are told which") {
  CHECK(said_of(R"({"base": {"box.width": 5}})") ==
        std::vector<std::string>{R"(unknown key "base" here; put it at the top)"});
}

TEST_CASE("parameters beside their object are told where to go") {
  using Said = std::vector<std::string>;
  CHECK(said_of(R"({"set": {}, "box": {}, "box.width": 5})") ==
        Said{R"(unknown key "box" here; put it into "set")",
             R"(unknown key "box.width" here; put it into "set")"});
  CHECK(said_of(R"({"small_share": 0.5, "cylinder.height": 1})") ==
        Said{R"(unknown key "small_share" here; put "sizes.small_share" into "set")",
             R"(unknown key "cylinder.height" here; put "shape.cylinder.height" into "set")"});
  CHECK(said_of(R"({"box.width": [5, 6], "measure.gap_tolerances": [1e-4]})") ==
        Said{R"(unknown key "box.width" here; put it into "grid")",
             R"(unknown key "measure.gap_tolerances" here; put it into "set")"});
  CHECK(said_of(R"({"grids": {}, "nonsense": 1})") ==
        Said{R"(unknown key "grids"; did you mean "grid"?)",
             R"(unknown key "nonsense"; known here: set, grid)"});
}

TEST_CASE("lists in an object are written by their full paths") {
  CHECK(dotted_lists("tube", Json::parse(R"({"diameter": [3, 4]})")) ==
        R"("tube.diameter": [3,4])");
  CHECK(dotted_lists("sizes", Json::parse(R"({"spread": [0, 0.1],
                                              "distribution": {"lognormal": {"sigma": [1]}}})")) ==
        R"("sizes.spread": [0,0.1], "sizes.distribution.lognormal.sigma": [1])");
  CHECK(dotted_lists("tube", Json::parse(R"({"diameter": 3})")).empty());
  CHECK(dotted_lists("tube", Json::parse(R"({"length": [3]})")).empty());
}

}  // namespace
}  // namespace grainsweep
