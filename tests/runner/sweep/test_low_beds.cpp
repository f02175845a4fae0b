#include <catch2/catch.hpp>

#include "runner/sweep/low_beds.hpp"
#include "tests/runner/sweep/sweep_files.hpp"

namespace grainsweep {
namespace {

std::vector<Diagnostic> notes_of(const std::string& sweep) {
  return notes_of(sweep, notes_on_low_beds);
}

TEST_CASE("beds that will probably be too low to be measured are noted, block by block") {
  const auto notes = notes_of(R"({"name": "low", "base": {"fill": {"grains": 300}}, "sweep": [
    {"label": "tubes", "grid": {"tube.diameter": [3, 5, 8]}},
    {"label": "enough", "set": {"tube.diameter": 4}},
    {"label": "pinacoids", "set": {"shape": "pinacoid", "box.length": 6, "box.width": 6}}]})");
  REQUIRE(notes.size() == 2);
  CHECK(notes[0].pointer == "/sweep/0");
  CHECK(notes[0].message ==
        "1 of 3 parameter sets will probably come out too low to be measured: with tube.diameter 8 "
        "about 5.2 d high, where measure.exclude_floor, measure.exclude_surface and a slab of 1 d "
        "between them take 7 d; give that one fill.grains 443 or more, or leave less out");
  CHECK(notes[1].pointer == "/sweep/2");
  CHECK_THAT(notes[1].message, Catch::StartsWith("1 of 1 parameter sets"));
}

TEST_CASE("beds high enough are not noted, nor few grains of a file") {
  CHECK(notes_of(R"({"name": "high", "sweep": [{"grid": {"box.width": [4, 20]}}]})").empty());
  const ScratchFolder folder;
  folder.write("few.csv", "x,y,z,radius\n5,5,0.5,0.5\n7,5,0.5,0.5\n");
  const SweepReading reading = read_sweep(
      folder.write("s.json",
                   R"({"name": "few", "replicates": 1, "base": {"fill.file": "few.csv"}})"),
      notes_on_low_beds);
  CHECK(reading.errors.empty());
  CHECK(reading.notes.empty());
}

TEST_CASE("what to fill in is told as it was written") {
  const auto notes = notes_of(
      R"({"name": "low", "base": {"fill": {"solid_height": 3.9}, "box": {"length": 6, "width": 6}}})");
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].pointer.empty());
  CHECK_THAT(notes[0].message, Catch::Contains("with box.width 6 about 6.5 d high") &&
                                   Catch::EndsWith("give that one fill.solid_height 4.62 or more, "
                                                   "or leave less out"));
}

}  // namespace
}  // namespace grainsweep
