#include <cmath>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "runner/compare/comparison_table.hpp"
#include "tests/runner/compare/wall_sweep.hpp"

namespace grainsweep {
namespace {

using Line = std::map<std::string, std::string>;

/// The rows of a table that has no quotes, column -> cell.
std::vector<Line> rows_of_table(const std::string& csv) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream rest(line + ",");
    for (std::string one; std::getline(rest, one, ',');) cells.push_back(one);
    return cells;
  };
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Line> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    REQUIRE(cells.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (k == 0) rows.emplace_back();
      rows.back()[names[k]] = cells[k];
    }
  }
  return rows;
}

Comparison z_at_ten() {
  Comparison row;
  row.family = "MSP";
  row.published = {"Z", 10, "5 ± 0.25", Published::Range{5, 5, 0.25}, "by hand", {}};
  row.measured.estimate = {5.5, 0};
  row.measured.bias_bound = 0.125;
  row.measured.definition = "neighbours per grain";
  return row;
}

TEST_CASE("a row has both values, their difference in three ways and the verdict") {
  Comparison row = z_at_ten();
  Line cells = rows_of_table(comparison_csv({row}, {})).at(0);
  const Line expected = {{"family", "MSP"},
                         {"quantity", "Z"},
                         {"width", "10"},
                         {"published", "5 ± 0.25"},
                         {"published_low", "5"},
                         {"published_high", "5"},
                         {"published_error", "0.25"},
                         {"measured", "5.5"},
                         {"measured_error", "0"},
                         {"distance", ""},
                         {"bias_bound", "0.125"},
                         {"difference", "0.5"},
                         {"relative_difference", "0.1"},
                         {"difference_in_errors", "2"},
                         {"agreement", "agrees"},
                         {"chi2_per_dof", ""},
                         {"reason", ""},
                         {"published_definition", "by hand"},
                         {"measured_definition", "neighbours per grain"}};
  CHECK(cells == expected);
  row.measured.estimate.value = 5.875;
  CHECK(rows_of_table(comparison_csv({row}, {}))[0]["agreement"] ==
        "agrees within the bound of settling");
  row.measured.estimate.value = 6;
  CHECK(rows_of_table(comparison_csv({row}, {}))[0]["agreement"] == "differs");
}

TEST_CASE("what is not known is empty, and its reason is given") {
  Comparison words = z_at_ten();
  words.published = {"C", 0, "falls", std::nullopt, "", {}};
  words.misfit = Misfit{1.5, 2};
  Comparison reason = z_at_ten();
  reason.measured.not_determined = "has 2 widths";
  Comparison range = z_at_ten();
  range.published.range = Published::Range{5, 6, 0};
  std::vector<Line> rows = rows_of_table(comparison_csv({words, reason, range}, {}));
  for (const char* column :
       {"width", "published_low", "published_high", "published_error", "difference",
        "relative_difference", "difference_in_errors", "agreement"}) {
    INFO(column);
    CHECK(rows[0][column].empty());
  }
  CHECK(rows[0]["published"] == "falls");
  CHECK(rows[0]["measured"] == "5.5");
  CHECK(rows[0]["chi2_per_dof"] == "1.5");
  for (const char* column :
       {"measured", "measured_error", "bias_bound", "difference", "measured_definition"}) {
    INFO(column);
    CHECK(rows[1][column].empty());
  }
  CHECK(rows[1]["reason"] == "has 2 widths");
  CHECK(rows[2]["difference"] == "0");
  CHECK(rows[2]["relative_difference"].empty());
}

TEST_CASE("a formula has a row for each width, with its value there") {
  const std::vector<Row> sweep = wall_sweep();  // on the line 0.64 - 0.2 / W
  Reference reference;
  const PublishedFormula formula{"0.63 - 0.2/W", "line", 4, 10, {0, 0.5}};
  reference.families = {{{}, {{"phi", 0, "line: 0.63 - 0.2/W", std::nullopt, "", formula}}}};
  std::vector<Line> rows =
      rows_of_table(comparison_csv(compare_with(reference, analyse(sweep)), {}));
  REQUIRE(rows.size() == 2);
  CHECK(rows[0]["width"] == "5");
  CHECK(rows[1]["width"] == "10");
  for (Line& row : rows) {
    const double published = 0.63 - 0.2 / std::stod(row["width"]);
    CHECK(std::stod(row["published_low"]) == Approx(published));
    CHECK(std::stod(row["published_error"]) == Approx(0.5 * published));
    CHECK(std::stod(row["difference"]) == Approx(0.01));
    CHECK(std::stod(row["relative_difference"]) == Approx(0.01 / published));
    CHECK(row["agreement"] == "agrees");
  }
}

TEST_CASE("a profile has a row for each point, with its distance from the wall") {
  const std::vector<Row> sweep = wall_sweep();
  Reference reference;
  const PublishedProfile profile{"Curve", "", {{0.5, 0.4}, {1.25, 0.5}}, {0, 0.5}};
  reference.families = {{{}, {{"phi", 10, "Curve", std::nullopt, "", {}, profile}}}};
  const std::string table = comparison_csv(compare_with(reference, analyse(sweep)), {});
  CHECK(cell_in(table, 1, "width") == "10");
  CHECK(cell_in(table, 1, "distance") == "0.5");
  CHECK(cell_in(table, 1, "published_low") == "0.4");
  CHECK(cell_in(table, 1, "published_error") == "0.2");
  CHECK(cell_in(table, 2, "distance") == "1.25");
  CHECK(cell_in(table, 2, "published_high") == "0.5");
  for (const std::size_t line : {1, 2}) {
    const auto number = [&](const char* column) { return std::stod(cell_in(table, line, column)); };
    CHECK(number("difference") == Approx(number("measured") - number("published_low")));
  }
}

TEST_CASE("widths and distances stand in the unit of the sweep, too") {
  const Units units{2.0, "mm", {}};
  CHECK(rows_of_table(comparison_csv({z_at_ten()}, units))[0]["width_mm"] == "20");
  Comparison point = z_at_ten();
  point.published.profile.emplace();
  point.distance = 1.5;
  CHECK(rows_of_table(comparison_csv({point}, units))[0]["distance_mm"] == "3");
  CHECK(comparison_columns(units).back().name == "distance_mm");
  CHECK(comparison_columns().back().name == "measured_definition");
}

}  // namespace
}  // namespace grainsweep
