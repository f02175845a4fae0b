#include <catch2/catch.hpp>

#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

using Messages = std::vector<std::string>;

/// Errors of a sweep with these blocks, all of boxes 4 d long.
Messages errors_in_short_boxes(const std::string& blocks) {
  return errors_of(sweep_of(blocks, R"({"box": {"length": 4}})"));
}

/// That they are too short for bricks 3 d long.
const std::string too_short =
    "s.json:1:42 /base/box/length: must lie in [7.91769, 10000] (periodic: twice the largest grain "
    "and a margin), is 4";

}  // namespace

TEST_CASE("a value of base that is wrong in one block is told with that block") {
  CHECK(errors_in_short_boxes(
            R"({"label": "balls"}, {"label": "bricks", "set": {"shape.cuboid.length": 3}})") ==
        Messages{too_short + " (in block \"bricks\")"});
  CHECK(errors_in_short_boxes(R"({"set": {"shape": "sphere"}},
                                 {"set": {"shape.cuboid.length": 3}})") ==
        Messages{too_short + " (in block 2)"});
}

TEST_CASE(
    "a value that is wrong at one point of a block is told with what the block varies there") {
  CHECK(errors_in_short_boxes(R"({"grid": {"shape": ["sphere", {"cuboid": {"length": 3}}]}})") ==
        Messages{too_short + " (with shape.cuboid.length 3)"});
  CHECK(errors_in_short_boxes(R"({"label": "balls"}, {"label": "others",
            "zip": {"shape": ["sphere", "cuboid"], "sizes.spread": [0, 0.1]}})") ==
        Messages{"s.json:1:42 /base/box/length: must lie in [5.24975, 10000] (periodic: twice the "
                 "largest grain and a margin), is 4 (in block \"others\" with shape \"cuboid\", "
                 "sizes.spread 0.1)"});
}

TEST_CASE("a value that is wrong at all points is told with the one that asks for most") {
  const Messages longest = {
      "s.json:1:42 /base/box/length: must lie in [10.0167, 10000] (periodic: twice the largest "
      "grain and a margin), is 4 (with shape.cuboid.length 4)"};
  CHECK(errors_in_short_boxes(R"({"grid": {"shape.cuboid.length": [3, 4]}})") == longest);
  CHECK(errors_in_short_boxes(R"({"grid": {"shape.cuboid.length": [4, 3]}})") == longest);
}

TEST_CASE("a value that is wrong in the same way at all points is told without one") {
  CHECK(errors_in_short_boxes(R"({"set": {"shape.cuboid.length": 3}, "grid": {"box.width": [8, 9]}},
                                 {"set": {"shape.cuboid.length": 3, "box.width": 7}})") ==
        Messages{too_short});
  CHECK(errors_of(sweep_of(R"({}, {"grid": {"box.width": [8, 9]}})", R"({"box.length": 1})")) ==
        Messages{"s.json:1:38 /base/box.length: must lie in [2.66667, 10000] (periodic: twice the "
                 "largest grain and a margin), is 1"});
}

TEST_CASE("a list's value that is wrong beside some of another list is told with both") {
  CHECK(errors_of(sweep_of(R"({"grid": {"shape": ["sphere", {"cuboid": {"length": 3}}],
                                        "box.length": [4, 9]}})")) ==
        Messages{"s.json:2:56 /sweep/0/grid/box.length/0: must lie in [7.91769, 10000] (periodic: "
                 "twice the largest grain and a margin), is 4 (with shape.cuboid.length 3, "
                 "box.length 4)"});
}

TEST_CASE("a bed too low to be measured is told with its shape") {
  CHECK(
      errors_of(sweep_of(R"({"grid": {"shape": ["sphere", "tetrahedron"]}})",
                         R"({"fill": {"grains": 1000}, "box.width": 10, "box.length": 15})")) ==
      Messages{"s.json:1:43 /base/fill/grains: gives a bed too low to be measured: at most 5.12 d "
               "high, and measure.exclude_floor, measure.exclude_surface and a slab of 1 d between "
               "them take 7 d; give fill.grains 3297 or more, or leave less out (with shape "
               "\"tetrahedron\")"});
}

TEST_CASE("an accuracy that cannot be asked of one shape is told with that") {
  CHECK(errors_of(sweep_of(R"({"grid": {"shape": ["sphere", "cube"]}})",
                           R"({"accuracy.coordination": 0.5})"))
            .at(0)
            .ends_with("in configs/README.md (with shape \"cube\")"));
}

}  // namespace grainsweep
