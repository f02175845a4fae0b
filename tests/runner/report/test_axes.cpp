#include <catch2/catch.hpp>

#include "runner/report/axes.hpp"
#include "tests/runner/sample_rows.hpp"

using namespace grainsweep;

namespace {

Row row_at(const std::string& id, double width, double small_share, Boundary y = Boundary::walls) {
  return settled_row(id, width, 0.6, 5.5, y, small_share);
}

}  // namespace

TEST_CASE("the width goes along the axis wherever it is varied", "[report]") {
  const std::vector<Row> rows = {row_at("a", 10, 0.0), row_at("b", 5, 0.0), row_at("c", 5, 0.4),
                                 row_at("d", 20, 0.0, Boundary::periodic)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(is_over_width(axes));
  REQUIRE(axes.series.size() == 3);
  REQUIRE(axes.series[0].groups.size() == 2);
  CHECK(place_on(axes, *axes.series[0].groups[0]) == 5.0);
  CHECK(place_on(axes, *axes.series[0].groups[1]) == 10.0);
  CHECK(axes.series[1].name == "MSP, small_share = 0.4");
  CHECK(axes.series[2].name.find("y periodic") != std::string::npos);
  CHECK(title_of(groups[2]) == "MSP, W = 5, small_share = 0.4");
}

TEST_CASE("a sweep over something else has that along the axis", "[report]") {
  const std::vector<Row> rows = {row_at("a", 6, 0.4), row_at("b", 6, 0.0), row_at("c", 6, 0.2)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter == "sizes.small_share");
  CHECK_FALSE(is_over_width(axes));
  REQUIRE(axes.series.size() == 1);
  CHECK(axes.series[0].name == "MSP");
  CHECK(place_on(axes, *axes.series[0].groups[0]) == 0.0);
}

TEST_CASE("a sweep that varies nothing has the number of the group along the axis", "[report]") {
  const std::vector<Row> rows = {row_at("a", 6, 0.0)};
  const std::vector<Group> groups = groups_of(rows);
  const Axes axes = axes_of(groups);
  CHECK(axes.parameter.empty());
  CHECK(place_on(axes, groups[0]) == 1.0);
  CHECK(axes_of({}).series.empty());
}

TEST_CASE("text is shortened by characters, not bytes", "[report]") {
  CHECK(shortened("φφφ", 3) == "φφφ");
  CHECK(shortened("φφφφ", 3) == "φφ…");
  CHECK(shortened("", 3).empty());
}
