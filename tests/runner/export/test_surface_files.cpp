#include <algorithm>
#include <string>

#include <catch2/catch.hpp>

#include "runner/export/surface_files.hpp"
#include "tests/runner/export/touching_beds.hpp"

namespace grainsweep {
namespace {

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST_CASE("STL has a solid per grain, called by id and size class, and the container") {
  ExportedBed exported = stacked_cubes();
  exported.small_limit = 0.3;
  exported.bed.grains[1].radius = 0.25;
  const std::string text = surfaces_stl(exported);
  CHECK_THAT(text, Catch::StartsWith("solid grain_1_large\nfacet normal 0 0 -1\nouter loop\n"
                                     "vertex 1.5 1.5 0\nvertex 1.5 2.5 0\nvertex 2.5 2.5 0\n"
                                     "endloop\nendfacet\n") &&
                       Catch::EndsWith("endsolid container\n"));
  CHECK(count_of(text, "\nsolid grain_2_small\n") == 1);
  CHECK(count_of(text, "\nendfacet\n") == 3 * 12);
}

TEST_CASE("OBJ has the same surfaces as objects, with their polygons") {
  const std::string text = surfaces_obj(stacked_cubes());
  CHECK(count_of(text, "\no ") == 3);
  CHECK(count_of(text, "\nv ") == 3 * 8);
  CHECK(count_of(text, "\nf ") == 3 * 6);
  CHECK_THAT(text, Catch::Contains("o grain_2_large\nv 1.75 1.5 1\n") &&
                       Catch::Contains("\nf 9 11 12 10\n") &&
                       Catch::Contains("o container\nv 0 0 0\n"));
}

TEST_CASE("lengths are in the unit that is asked for, those of cuts and necks, too") {
  ExportedBed exported = stacked_cubes();
  exported.settings.lengths = {2.0, "mm", {}};
  CHECK_THAT(surfaces_obj(exported), Catch::StartsWith("# grainsweep, lengths in mm\n") &&
                                         Catch::Contains("o grain_2_large\nv 3.5 3 2\n") &&
                                         Catch::Contains("o container\nv 0 0 0\n"));
  CHECK_THAT(surfaces_stl(exported), Catch::Contains("normal 0 0 -1\nouter loop\nvertex 3 3 0\n"));
  exported.settings.treatment = *contact_treatment("bridge:0.2");
  CHECK_THAT(surfaces_stl(exported), Catch::Contains("vertex 8 8 4.2\n"));
}

TEST_CASE("joined grains are one solid, called by the first, below the container's top") {
  ExportedBed exported = stacked_cubes();
  exported.settings.treatment = *contact_treatment("bridge:0.2");
  const std::string text = surfaces_stl(exported);
  CHECK(count_of(text, "\nsolid ") == 1);
  CHECK_THAT(text, Catch::StartsWith("solid joined_1\n") && Catch::Contains("vertex 4 4 2.1\n"));
}

}  // namespace
}  // namespace grainsweep
