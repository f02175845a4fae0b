#include <catch2/catch.hpp>

#include "runner/sweep/far_shapes.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<Diagnostic> notes_on_shapes(const std::string& sweep) {
  return notes_of(sweep, notes_on_far_shapes);
}

TEST_CASE("a shape whose lengths are in mm is told what to divide them by") {
  const auto notes = notes_on_shapes(
      R"({"name": "mm", "base": {"shape": {"cylinder": {"height": 5, "diameter": 5}},
          "tube": {"diameter": 25}}, "units": {"d": 5, "unit": "mm"}})");
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].is_note);
  CHECK(notes[0].message ==
        "grains have the volume of a sphere of 5.71 d (1 of 1 parameter sets with polyhedra): "
        "lengths of shapes, like all, are in d, the mean diameter of the large grains; divide "
        "those of shape.cylinder by 5, which d is in mm");
}

TEST_CASE("small shapes, hulls and mixtures are noted, too, at the first block with them") {
  const auto small = notes_on_shapes(R"({"name": "small", "sweep": [
    {"label": "spheres"}, {"label": "cubes", "set": {"fill.grains": 100000, "box.length": 6,
    "box.width": 6, "measure": {"exclude_floor": 0.1, "exclude_surface": 0.1}},
     "grid": {"shape": ["cube", {"cube": {"edge": 0.2}}]}}]})");
  REQUIRE(small.size() == 1);
  CHECK(small[0].pointer == "/sweep/1");
  CHECK_THAT(small[0].message,
             Catch::Contains("sphere of 0.248 d (1 of 2 parameter sets with polyhedra)") &&
                 Catch::EndsWith("divide those of shape.cube by what d is in their unit"));
  const auto hull = notes_on_shapes(R"({"name": "hull", "base": {"box": {"width": 40,
    "length": 40}, "fill.solid_height": 30,
    "shape": {"hull": {"vertices": [[0,0,0], [4,0,0], [0,4,0], [4,4,0],
                                    [0,0,4], [4,0,4], [0,4,4], [4,4,4]]}}}})");
  REQUIRE(hull.size() == 1);
  CHECK_THAT(hull[0].message, Catch::EndsWith("make shape.hull.size, the length in its vertices "
                                              "that is d, 4.96 times as large"));
  CHECK(notes_on_shapes(R"({"name": "mixture", "base": {"box": {"width": 40, "length": 40},
    "fill.solid_height": 30, "shape": {"mixture": [{"share": 0.5, "cube": {"edge": 4}},
    {"share": 0.5, "cube": {"edge": 5}}]}}})")
            .size() == 1);
}

TEST_CASE("needles and plates of about 1 d, and spheres, are not noted") {
  CHECK(notes_on_shapes(R"({"name": "usual", "base": {"fill.solid_height": 20}, "sweep": [
    {"label": "needles", "set": {"shape.pinacoid": {"length": 1, "width": 0.05, "height": 0.05}}},
    {"label": "fibres", "set": {"shape.cylinder": {"height": 20, "diameter": 1}, "box.width": 60,
                                "box.length": 60}},
    {"label": "spheres"}, {"label": "cubes", "set": {"shape": "cube"}}]})")
            .empty());
}

}  // namespace
}  // namespace grainsweep
