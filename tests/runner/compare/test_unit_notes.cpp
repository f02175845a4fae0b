#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "runner/compare/unit_notes.hpp"
#include "tests/runner/compare/wall_sweep.hpp"

namespace grainsweep {
namespace {

const Units six_mm{6.0, "mm", std::nullopt};

/// What is noted of a value beside packings between walls at 5, 10 and 20 d, or in such tubes.
std::string notes_on(const Published& value, const Units& units, bool are_tubes = false) {
  std::vector<Row> rows = wall_sweep();
  if (are_tubes) {
    rows.resize(6);
    for (Row& row : rows) row.job.box = tube_of(row.job.box.width);
  }
  Reference reference;
  reference.families = {{{}, {value}}};
  return notes_on_lengths(reference, analyse(rows).families, units);
}

Published at_width(double width) { return {"Z", width, "6", std::nullopt, "", {}}; }

Published formula(const std::string& text, double from, double to) {
  Published value{"porosity", 0.0, "Dixon", std::nullopt, "", {}};
  value.formula = PublishedFormula{text, "Dixon", from, to, {}};
  return value;
}

Published profile(double width, double farthest) {
  Published value{"porosity", width, "Mueller", std::nullopt, "", {}};
  value.profile = PublishedProfile{"Mueller", "", {{0.15, 0.86}, {farthest, 0.4}}, {}};
  return value;
}

constexpr double no_end = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a published width that packings would have in the unit of the sweep is noted") {
  CHECK(notes_on(at_width(30), six_mm) ==
        "note: no packing has the width 30 d; widths are in d, and 30 mm is 5 d\n");
  CHECK(notes_on(at_width(10), six_mm).empty());  // there is one
  CHECK(notes_on(at_width(36), six_mm).empty());  // nor has one 6 d
  CHECK(notes_on(at_width(0), six_mm).empty());
}

TEST_CASE("a range of a formula that packings would be in if it were in the unit is noted") {
  CHECK(notes_on(formula("0.4 + 0.3/W", 30, 48), six_mm) ==
        "note: no packing has a W from 30 to 48 d, where Dixon holds; widths are in d, and 30 mm "
        "is 5 d\n");
  CHECK(notes_on(formula("0.4 + 0.3/W", 24, no_end), six_mm) ==
        "note: no packing has a W of 24 d or more, where Dixon holds; widths are in d, and 24 mm "
        "is 4 d\n");
  CHECK(notes_on(formula("0.4 + 0.3/D", 30, 48), six_mm, true) ==
        "note: no packing has a D from 30 to 48 d, where Dixon holds; widths are in d, and 30 mm "
        "is 5 d\n");
  CHECK(notes_on(formula("0.4 + 0.3/W", 0, 2), {0.25, "mm", std::nullopt}) ==
        "note: no packing has a W from 0 to 2 d, where Dixon holds; widths are in d, and 2 mm is "
        "8 d\n");
  CHECK(notes_on(formula("0.4 + 0.3/W", 15, 48), six_mm).empty());     // 20 d is in it
  CHECK(notes_on(formula("0.4 + 0.3/W", 36, 48), six_mm).empty());     // 6 to 8 d are not there
  CHECK(notes_on(formula("0.4 + 0.3/W", 0, no_end), six_mm).empty());  // all
  CHECK(notes_on(formula("0.4 + 0.3/D", 30, 48), six_mm).empty());     // of tubes
}

TEST_CASE("points of a profile beyond the middle that would end before it in the unit are noted") {
  const Units three_mm{3.0, "mm", std::nullopt};
  CHECK(notes_on(profile(5, 7.2), three_mm) ==
        "note: points of the profile of porosity at a width of 5 d lie up to 7.2 d from the wall, "
        "its middle 2.5 d; distances are in d, and 7.2 mm is 2.4 d\n");
  CHECK(notes_on(profile(5, 2.5), three_mm).empty());
  CHECK(notes_on(profile(5, 7.6), three_mm).empty());  // beyond it in either unit
}

TEST_CASE("lengths that two values have in common are noted once") {
  std::vector<Row> rows = wall_sweep();
  Reference reference;
  reference.common = {at_width(30)};
  reference.families = {{{}, {at_width(30), formula("W/90", 30, 48), formula("W/90", 30, 48)}}};
  CHECK(notes_on_lengths(reference, analyse(rows).families, six_mm) ==
        "note: no packing has the width 30 d; widths are in d, and 30 mm is 5 d\n"
        "note: no packing has a W from 30 to 48 d, where Dixon holds; widths are in d, and 30 mm "
        "is 5 d\n");
}

}  // namespace grainsweep
