#include <string>

#include <catch2/catch.hpp>

#include "runner/tables/chosen_presets.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::string text_of(const std::string& sweep) {
  const SweepReading reading = reading_of(sweep);
  REQUIRE(reading.errors.empty());
  return chosen_presets_text(reading.sweep);
}

TEST_CASE("each preset that was chosen is told with its bounds and what was asked for") {
  const std::string pinacoids =
      R"({"shape": "pinacoid", "accuracy": {"coordination": 0.1, "precision": "f64"}})";
  CHECK(
      text_of(R"({"name": "a", "replicates": 3, "base": {"accuracy.solid_fraction": 0.0055},
      "sweep": [{"grid": {"box.width": [4, 5]}}, {"set": )" +
              pinacoids + "}]}") ==
      "Accuracy of 2 parameter sets of spheres of one size: \"fast\", the cheapest preset that "
      "moves means by no more than 0.0055 in solid fraction; its bounds: 0.003 in solid fraction, "
      "0.056 in coordination\n"
      "Accuracy of 1 parameter set of pinacoids 1 by 1 by 1: \"balanced\", the cheapest preset "
      "that moves means by no more than 0.0055 in solid fraction, 0.1 in coordination; its bounds: "
      "0.003 in solid fraction, 0.082 in coordination\n");
}

TEST_CASE("the same grains settled by different presets in different containers are told of") {
  const auto told = [](const std::string& widths) {
    return text_of(R"({"name": "a", "base": {"accuracy.coordination": 0.055},
        "sweep": [{"label": "walls", "grid": {"box.width": )" +
                   widths + "}}]}");
  };
  CHECK(told("[4, 5, 6]").find("The same grains") == std::string::npos);
  CHECK_THAT(told("[3, 4, 5]"),
             Catch::EndsWith("The same grains, as in \"walls\", are settled as \"fast\" and "
                             "\"balanced\" in different containers: no line joins these, and "
                             "none is the other's value without walls; for that write \"preset\": "
                             "\"balanced\" in place of the accuracy that is asked for\n"));
}

TEST_CASE("of presets that are named nothing is told") {
  CHECK(text_of(R"({"name": "a", "base": {"accuracy": "fast"}})").empty());
}

}  // namespace
}  // namespace grainsweep
