#include <catch2/catch.hpp>

#include "runner/sweep/job_limit.hpp"
#include "runner/sweep/sweep_definition.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;

/// Errors of a sweep with this one block, which starts at line 2.
Messages errors_in_block(const std::string& block) {
  return errors_of("{\"name\": \"t\", \"sweep\": [\n" + block + "]}");
}

}  // namespace

TEST_CASE("a sweep of a name alone is one job with the defaults") {
  const SweepReading reading = reading_of(R"({"name": "a-b_c.1"})");
  REQUIRE(reading.errors.empty());
  CHECK(reading.sweep.name == "a-b_c.1");
  CHECK(reading.sweep.seed == 0);
  CHECK(reading.sweep.replicates == 1);
  REQUIRE(reading.sweep.jobs.size() == 1);
  CHECK(reading.sweep.jobs[0].label == "a-b_c.1");
}

// A million values take two minutes under sanitizers.
TEST_CASE("a range of as many values as a sweep may have is read whole", "[slow]") {
  const auto json = Json::parse(
      R"({"name": "t", "sweep": [
        {"grid": {"box.width": {"from": 5, "to": 6, "count": 1000000}}},
        {"grid": {"box.width": {"from": 7, "to": 8, "count": 900000}}}]})");
  Diagnostics diagnostics;
  const SweepDefinition definition = read_definition(json, diagnostics);
  CHECK(diagnostics.empty());
  REQUIRE(definition.blocks.size() == 2);
  CHECK(definition.blocks[0].axes[0].entries.size() == 1'000'000);
  CHECK(definition.blocks[1].axes[0].entries.size() == 2);
}

TEST_CASE("ranges of a sweep that is too large are read as their ends, and counted whole") {
  const auto json = Json::parse(
      R"({"name": "t", "sweep": [
        {"grid": {"box.width": {"from": 5, "to": 6, "count": 100}}},
        {"grid": {"box.width": {"from": 7, "to": 8, "count": 999950}}},
        {"grid": {"box.width": {"from": 5, "to": 6, "count": 2000},
                  "box.length": {"from": 5, "to": 6, "count": 3000}, "sizes.spread": [0, 0.1]}}]})");
  Diagnostics diagnostics;
  const SweepDefinition definition = read_definition(json, diagnostics);
  CHECK(diagnostics.empty());
  REQUIRE(definition.blocks.size() == 3);
  CHECK(definition.blocks[0].axes[0].entries.size() == 100);
  CHECK(definition.blocks[1].axes[0].entries.size() == 2);
  CHECK(point_count(definition.blocks[1]) == 999'950);
  CHECK(definition.blocks[2].axes[1].entries.size() == 2);
  CHECK(point_count(definition.blocks[2]) == 12'000'000);
  CHECK_FALSE(fits(definition, diagnostics));
}

TEST_CASE("names that are no folder names are refused") {
  const std::string message =
      " /name: must be 1 to 100 letters, digits, '-', '_' and '.', the first no '.'; is ";
  CHECK(errors_of(R"({"name": "a b"})") == Messages{"s.json:1:10" + message + "the text \"a b\""});
  CHECK(errors_of(R"({"name": "../x"})") ==
        Messages{"s.json:1:10" + message + "the text \"../x\""});
  CHECK(errors_of(R"({"name": ".."})") == Messages{"s.json:1:10" + message + "the text \"..\""});
  CHECK(errors_of(R"({"name": ""})") == Messages{"s.json:1:10" + message + "the text \"\""});
  CHECK(errors_of(R"({"name": 5})") == Messages{"s.json:1:10" + message + "5"});
  CHECK(errors_of("{}") ==
        Messages{"s.json:1:1: \"name\" is missing; add one, e.g. \"name\": \"my-sweep\""});
}

TEST_CASE("the top level must be an object with known keys") {
  CHECK(errors_of("5") ==
        Messages{
            "s.json:1:1: must be an object with name, seed, replicates, units, base, sweep, is 5"});
  CHECK(errors_of(R"({"name": "t", "sweeps": []})") ==
        Messages{"s.json:1:15 /sweeps: unknown key \"sweeps\"; did you mean \"sweep\"?"});
  CHECK(errors_of(R"({"name": "t", "sweep": {}})") ==
        Messages{"s.json:1:24 /sweep: must be a list of blocks, is an object"});
  CHECK(errors_of(R"({"name": "t", "sweep": []})") ==
        Messages{"s.json:1:24 /sweep: holds no block; leave it out to pack \"base\" alone"});
}

TEST_CASE("seeds take all of 64 bits and nothing else") {
  CHECK(reading_of(R"({"name": "t", "seed": 18446744073709551615})").sweep.seed == UINT64_MAX);
  const std::string message =
      " /seed: must be a whole number in digits from 0 to 18446744073709551615, is ";
  CHECK(errors_of(R"({"name": "t", "seed": -1})") == Messages{"s.json:1:23" + message + "-1"});
  CHECK(errors_of(R"({"name": "t", "seed": "1"})") ==
        Messages{"s.json:1:23" + message + "the text \"1\""});
}

TEST_CASE("a whole number may be written with a point") {
  CHECK(jobs_of(R"({"name": "t", "replicates": 3.0})").size() == 3);
  CHECK(
      jobs_of(sweep_of(R"({"random": {"count": 2.0, "box.width": {"uniform": [5, 9]}}})")).size() ==
      2);
}

TEST_CASE("replicates lie between 1 and 10000, in the file and in a block") {
  const std::string message = "replicates: must be a whole number in [1, 10000], is ";
  CHECK(errors_of(R"({"name": "t", "replicates": 0})") ==
        Messages{"s.json:1:29 /" + message + "0"});
  CHECK(errors_of(R"({"name": "t", "replicates": 10001})") ==
        Messages{"s.json:1:29 /" + message + "10001"});
  CHECK(errors_in_block(R"({"replicates": 2.5})") ==
        Messages{"s.json:2:16 /sweep/0/" + message + "2.5"});
}

TEST_CASE("a block must be an object with known keys and a label on one line") {
  CHECK(errors_in_block("5") == Messages{"s.json:2:1 /sweep/0: must be an object with label, set, "
                                         "grid, zip, random, replicates, is 5"});
  CHECK(errors_in_block(R"({"gird": {}})") ==
        Messages{"s.json:2:2 /sweep/0/gird: unknown key \"gird\"; did you mean \"grid\"?"});
  CHECK(errors_in_block(R"({"label": "a\nb"})").size() == 1);
  CHECK(errors_in_block(R"({"label": "a\u009b2J"})").size() == 1);
  CHECK(errors_in_block(R"({"label": ""})") ==
        Messages{"s.json:2:11 /sweep/0/label: must be a text of 1 to 100 characters on one line, "
                 "none of them a control, "
                 "is the text \"\""});
}

TEST_CASE("labels are limited in characters, not in bytes") {
  std::string label;
  for (int k = 0; k < 100; ++k) label += "\u00b5";
  CHECK(errors_in_block(R"({"label": ")" + label + "\"}").empty());
  CHECK(errors_in_block(R"({"label": "x)" + label + "\"}").size() == 1);
}

TEST_CASE("no label begins as a formula of a spreadsheet does") {
  for (const char* const label : {"=cmd|' /C calc'!A0", "@SUM(1+1)", "+1", "-1"}) {
    INFO(label);
    CHECK(errors_in_block(R"({"label": ")" + std::string(label) + "\"}") ==
          Messages{"s.json:2:11 /sweep/0/label: must not begin with =, +, - or @, which "
                   "spreadsheets take for a formula"});
  }
  CHECK(errors_in_block(R"({"label": "a=1+1"})").empty());
}

TEST_CASE("blocks without a label are numbered from one") {
  const auto jobs = jobs_of(sweep_of(R"({"set": {"box.width": 5}}, {"set": {"box.width": 6}})"));
  REQUIRE(jobs.size() == 2);
  CHECK(jobs[0].label == "block 1");
  CHECK(jobs[1].label == "block 2");
}

TEST_CASE("grids must be lists of at least one value for known paths") {
  CHECK(
      errors_in_block(R"({"grid": []})") ==
      Messages{
          "s.json:2:10 /sweep/0/grid: must be an object of lists, one per path, is an empty list"});
  CHECK(errors_in_block(R"({"grid": {"box.width": 5}})") ==
        Messages{"s.json:2:24 /sweep/0/grid/box.width: must be a list of values, is 5; a single "
                 "value belongs into \"set\""});
  CHECK(errors_in_block(R"({"grid": {"box.width": []}})") ==
        Messages{"s.json:2:24 /sweep/0/grid/box.width: must hold at least one value"});
  CHECK(errors_in_block(R"({"grid": {"box.widht": [5]}})") ==
        Messages{"s.json:2:11 /sweep/0/grid/box.widht: unknown key \"box.widht\"; did you mean "
                 "\"box.width\"?"});
  CHECK(errors_in_block(R"({"grid": {"box.width": [5, "6"]}})") ==
        Messages{"s.json:2:28 /sweep/0/grid/box.width/1: must be a number, is the text \"6\""});
}

TEST_CASE("lists of a zip must be equally long") {
  CHECK(errors_in_block(R"({"zip": {"box.width": [5, 6], "seed": [1, 2, 3]}})") ==
        Messages{"s.json:2:9 /sweep/0/zip: the lists must be equally long: box.width has 2, seed "
                 "has 3"});
}

TEST_CASE("a parameter that a block varies twice is refused") {
  CHECK(errors_in_block(R"({"grid": {"box.width": [5]}, "zip": {"box": [{"width": 6}]}})") ==
        Messages{"s.json:2:45 /sweep/0/zip/box: box.width is already varied at "
                 "/sweep/0/grid/box.width"});
  CHECK(errors_in_block(R"({"grid": {"fill.grains": [5000], "fill.solid_height": [5]}})") ==
        Messages{"s.json:2:55 /sweep/0/grid/fill.solid_height: fill is already varied at "
                 "/sweep/0/grid/fill.grains"});
  CHECK(
      errors_in_block(
          R"({"grid": {"box.width": [5]}, "random": {"count": 1, "box.width": {"uniform": [5, 6]}}})") ==
      Messages{"s.json:2:66 /sweep/0/random/box.width: box.width is already varied at "
               "/sweep/0/grid/box.width"});
}

TEST_CASE("a shape that a block varies twice is refused, parts of one shape are not") {
  CHECK(errors_in_block(R"({"grid": {"shape": ["sphere", "pinacoid"]},
    "zip": {"shape.pinacoid.width": [2]}})") ==
        Messages{"s.json:3:37 /sweep/0/zip/shape.pinacoid.width: shape is already varied at "
                 "/sweep/0/grid/shape"});
  CHECK(errors_in_block(R"({"grid": {"shape": ["sphere"]}, "random": {"count": 1,
    "shape.pinacoid.width": {"uniform": [1, 2]}}})") ==
        Messages{"s.json:3:29 /sweep/0/random/shape.pinacoid.width: shape is already varied at "
                 "/sweep/0/grid/shape"});
  CHECK(errors_in_block(
            R"({"grid": {"shape.pinacoid.width": [1, 2], "shape.pinacoid.length": [1, 2]}})")
            .empty());
}

TEST_CASE(
    "what a block describes in two ways in its lists is refused, in whatever lists they are") {
  const std::string box =
      "s.json:2:52 /sweep/0/grid/tube.diameter: the container is already "
      "described at /sweep/0/grid/box.width; keep one of box, tube";
  CHECK(errors_in_block(R"({"grid": {"box.width": [4, 5, 7], "tube.diameter": [5, 6]}})") ==
        Messages{"s.json:2:52 /sweep/0/grid/tube.diameter: the container is already described at "
                 "/sweep/0/grid/box.width; keep one of box, tube"});
  const std::string keep =
      "; keep one: two classes, or one distribution, lognormal, uniform, weibull, or table by "
      "lists or file";
  const std::string spread = "the sizes are already described at /sweep/0/grid/sizes.spread" + keep;
  CHECK(errors_in_block(R"({"grid": {"sizes.spread": [0.1, 0.05]}, "random": {"count": 2,
    "sizes.distribution.lognormal.sigma": {"uniform": [0.1, 0.2]}}})") ==
        Messages{"s.json:3:43 /sweep/0/random/sizes.distribution.lognormal.sigma: " + spread});
  CHECK(errors_in_block(R"({"grid": {"sizes.spread": [0.1, 0.05]}, "zip": {
    "sizes.distribution.uniform": [{"from": 0.5}, {"from": 0.6}]}})") ==
        Messages{"s.json:3:35 /sweep/0/zip/sizes.distribution.uniform: " + spread});
  CHECK(errors_in_block(R"({"grid": {"sizes.distribution.uniform.from": [0.5, 0.6],
    "sizes.distribution.lognormal.sigma": {"from": 0.1, "to": 0.2, "count": 3}}})") ==
        Messages{"s.json:3:43 /sweep/0/grid/sizes.distribution.lognormal.sigma: the sizes are "
                 "already described at /sweep/0/grid/sizes.distribution.uniform.from" +
                 keep});
  CHECK(errors_in_block(R"({"grid": {"accuracy.preset": ["fast", "balanced"],
    "accuracy.solid_fraction": [0.01, 0.02]}})") ==
        Messages{"s.json:3:32 /sweep/0/grid/accuracy.solid_fraction: the accuracy is already "
                 "described at /sweep/0/grid/accuracy.preset; keep one: a preset, or what is asked "
                 "for, solid_fraction and coordination"});
  CHECK(errors_in_block(R"({"random": {"count": 2, "box.length": {"uniform": [5, 6]},
    "tube.diameter": {"choice": [5, 6]}}})") ==
        Messages{"s.json:3:22 /sweep/0/random/tube.diameter: the container is already described at "
                 "/sweep/0/random/box.length; keep one of box, tube"});
}

TEST_CASE("parts of one description are varied together, and one list runs through several") {
  CHECK(errors_in_block(R"({"grid": {"box.width": [4, 5], "box.length": [9, 10]}})").empty());
  CHECK(errors_in_block(R"({"grid": {"sizes.distribution.lognormal.sigma": [0.1, 0.2],
    "sizes.distribution.lognormal.median": [1, 1.1], "sizes.distribution.by": ["number"]}})")
            .empty());
  CHECK(errors_in_block(R"({"grid": {"sizes": [{"spread": 0.1},
    {"distribution": {"lognormal": {"sigma": 0.1}}}], "accuracy": ["fast", {"step": 0.1}],
    "accuracy.creep_steps": [10, 20]}})")
            .empty());
  CHECK(errors_of(R"({"name": "t", "base": {"box.width": 5}, "sweep": [
    {"grid": {"box.length": [9, 10]}}, {"grid": {"tube.diameter": [5, 6]}}]})")
            .empty());
}

TEST_CASE("a zip describes a thing in two ways in different rows, not in one") {
  CHECK(errors_in_block(R"({"zip": {"box": [{"width": 7}, {}], "tube": [{}, {"diameter": 6}]}})")
            .empty());
  CHECK(errors_in_block(R"({"zip": {"box": [{"width": 7}, {}], "tube.diameter": [5, 6]}})") ==
        Messages{"s.json:2:55 /sweep/0/zip/tube.diameter/0: the container is already described at "
                 "/sweep/0/zip/box/0/width; keep one of box, tube"});
  CHECK(errors_in_block(R"({"zip": {"box": [{"width": 7}, {}], "box.width": [5, 6]}})") ==
        Messages{"s.json:2:51 /sweep/0/zip/box.width/0: box.width is already set at "
                 "/sweep/0/zip/box/0/width"});
}

TEST_CASE("points are counted without overflow") {
  Block block;
  for (int i = 0; i < 7; ++i) block.axes.push_back({"a", std::vector<Assignments>(1000)});
  CHECK(point_count(block) == UINT64_MAX);
  block.axes.resize(6);
  CHECK(point_count(block) == 1'000'000'000'000'000'000);
}

TEST_CASE("a sweep may have a million jobs, in one block or in several") {
  const auto fit = [](const std::vector<int>& replicates) {
    SweepDefinition definition;
    for (const int most : replicates) definition.blocks.emplace_back().replicates.most = most;
    Diagnostics diagnostics;
    return fits(definition, diagnostics);
  };
  CHECK(fit({1'000'000}));
  CHECK_FALSE(fit({1'000'001}));
  CHECK(fit({600'000, 400'000}));
  CHECK_FALSE(fit({600'000, 400'001}));
}

}  // namespace grainsweep
