#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/asked_accuracy.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<std::string> ids_in(const std::string& text) {
  const SweepReading reading = reading_of(text);
  REQUIRE(reading.errors.empty());
  std::vector<std::string> ids;
  for (const Job& job : reading.sweep.jobs) ids.push_back(job.id);
  return ids;
}

/// Ids of a sweep whose base holds an accuracy and other values.
std::vector<std::string> ids_with(const std::string& accuracy, const std::string& others = "") {
  return ids_in(R"({"name": "a", "replicates": 2, "base": {"accuracy": )" + accuracy + others +
                "}}");
}

std::string number(double value) { return std::to_string(value); }

TEST_CASE("the cheapest preset whose bounds are small enough is taken, with its packings") {
  const auto fast = *bias_bound("fast", BedKind::spheres);
  const auto balanced = *bias_bound("balanced", BedKind::spheres);
  const auto accurate = *bias_bound("accurate", BedKind::spheres);
  const auto solid_fraction = [](double most) {
    return ids_with(R"({"solid_fraction": )" + number(most) + "}");
  };
  CHECK(solid_fraction(fast.solid_fraction) == ids_with(R"("fast")"));
  CHECK(solid_fraction(0.999 * fast.solid_fraction) == ids_with(R"("balanced")"));
  CHECK(solid_fraction(0.999 * balanced.solid_fraction) == ids_with(R"("accurate")"));
  CHECK(solid_fraction(accurate.solid_fraction) == ids_with(R"("accurate")"));
  CHECK(ids_with(R"({"solid_fraction": 1, "coordination": )" + number(balanced.coordination) +
                 "}") == ids_with(R"("balanced")"));
  CHECK(ids_with(R"({"coordination": )" + number(0.999 * accurate.coordination) + "}") ==
        ids_with(R"("exact")"));
}

TEST_CASE("each bed has the preset that its own kind takes") {
  // 0.0040: of spheres fast, 0.0030, of pinacoids balanced, 0.0030. Two sizes keep 0.0018 at
  // balanced, 0.0012, but not at fast, 0.0021.
  const std::string asked = R"({"solid_fraction": 0.0040})";
  CHECK(ids_with(asked) == ids_with(R"("fast")"));
  CHECK(ids_with(asked, R"(, "shape": "pinacoid")") ==
        ids_with(R"("balanced")", R"(, "shape": "pinacoid")"));
  CHECK(ids_with(R"({"solid_fraction": 0.0018})", R"(, "sizes.small_share": 0.3)") ==
        ids_with(R"("balanced")", R"(, "sizes.small_share": 0.3)"));
  CHECK(ids_in(R"({"name": "a", "base": {"accuracy": {"solid_fraction": 0.0040}},
                   "sweep": [{"grid": {"shape": ["sphere", "pinacoid"]}}]})") ==
        ids_in(R"({"name": "a", "sweep": [{"zip": {"shape": ["sphere", "pinacoid"],
                   "accuracy": ["fast", "balanced"]}}]})"));
}

TEST_CASE("what is asked for may be varied, and replaces a preset of the base, as a preset it") {
  CHECK(ids_in(R"({"name": "a", "base": {"accuracy": "accurate"},
                   "sweep": [{"grid": {"accuracy.coordination": [0.1, 0.05]}}]})") ==
        ids_in(R"({"name": "a", "sweep": [{"grid": {"accuracy": ["fast", "balanced"]}}]})"));
  CHECK(ids_in(R"({"name": "a", "base": {"accuracy": {"coordination": 0.02}},
                   "sweep": [{"set": {"accuracy": "fast"}}]})") ==
        ids_in(R"({"name": "a", "base": {"accuracy": "fast"}})"));
}

TEST_CASE("precision and the most steps may be written beside it") {
  CHECK(ids_with(R"({"coordination": 0.1, "precision": "f64", "max_steps": 500})") ==
        ids_with(R"({"preset": "fast", "precision": "f64", "max_steps": 500})"));
}

TEST_CASE("a job knows what was asked for, one that names its preset nothing") {
  const auto asked = [](const std::string& accuracy) {
    return reading_of(R"({"name": "a", "base": {"accuracy": )" + accuracy + "}}")
        .sweep.jobs.at(0)
        .asked_accuracy;
  };
  CHECK(asked(R"({"solid_fraction": 0.0125})").solid_fraction == 0.0125);
  CHECK(asked(R"({"solid_fraction": 0.0125})").coordination == 0.0);
  CHECK_FALSE(asked(R"("fast")").is_given());
}

TEST_CASE("what no preset keeps is refused with the smallest bound that can be had") {
  const std::string smallest = " the smallest bound that was measured of spheres of one size, by ";
  const std::string accuracy = R"({"solid_fraction": 0.001, "coordination": 0.005})";
  CHECK(errors_of(R"({"name": "a", "base": {"accuracy": )" + accuracy + "}}") ==
        std::vector<std::string>{"s.json:1:55 /base/accuracy/solid_fraction: must be at least "
                                 "0.0013," +
                                     smallest + "\"accurate\"; is 0.001",
                                 "s.json:1:78 /base/accuracy/coordination: must be at least "
                                 "0.01," +
                                     smallest + "\"exact\"; is 0.005"});
  const std::string both = R"({"solid_fraction": 0.0013, "coordination": 0.01})";
  CHECK(errors_of(R"({"name": "a", "base": {"accuracy": )" + both + "}}") ==
        std::vector<std::string>{
            "s.json:1:79 /base/accuracy/coordination: must be at least 0.014, the smallest bound "
            "that was measured of spheres of one size by presets that keep the other one, by "
            "\"accurate\"; is 0.01"});
}

TEST_CASE("an accuracy that several blocks cannot keep is refused for each reason") {
  const auto errors = errors_of(R"({"name": "a", "base": {"accuracy": {"coordination": 0.005}},
      "sweep": [{"label": "one size"}, {"label": "again", "set": {"box.width": 6}},
                {"label": "cubes", "set": {"shape": {"cube": {}}}}]})");
  REQUIRE(errors.size() == 2);
  CHECK_THAT(errors[0], Catch::Contains("of spheres of one size"));
  CHECK_THAT(errors[1], Catch::Contains("in block \"cubes\""));
}

}  // namespace
}  // namespace grainsweep
