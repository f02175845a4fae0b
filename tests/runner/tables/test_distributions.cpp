#include <catch2/catch.hpp>

#include "runner/tables/distributions.hpp"
#include "runner/tables/families.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

Row row_with_curves(const std::string& id, std::vector<double> g, std::vector<double> p) {
  Row row = settled_row(id, 5, 0.6, 6);
  row.outcome->result.pair_correlation = {0.5, std::move(g)};
  row.outcome->result.force_density = {0.25, std::move(p)};
  return row;
}

TEST_CASE("curves have mean and scatter of the replicates that reach so far") {
  const std::vector<Row> rows = {row_with_curves("a", {0, 2}, {1}),
                                 row_with_curves("b", {0, 4, 5}, {2}),
                                 row_with_status("u", 5, PackingStatus::not_settled, "moves")};
  CHECK(distributions_csv(analyse(rows).groups) ==
        "group,family,job,label,width,boundary_y,small_share,curve,low,high,n,value,value_sd,"
        "value_error\n"
        "1,MSP,a,MSP,5,walls,0,pair_correlation,0,0.5,2,0,0,\n"
        "1,MSP,a,MSP,5,walls,0,pair_correlation,0.5,1,2,3,1.4142135623730951,6.482876642836102\n"
        "1,MSP,a,MSP,5,walls,0,pair_correlation,1,1.5,1,5,,\n"
        "1,MSP,a,MSP,5,walls,0,force_density,0,0.25,2,1.5,0.7071067811865476,3.241438321418051\n");
}

TEST_CASE("a mean curve is as long as the longest, in whatever order the replicates come") {
  const auto points = [](const std::vector<Row>& rows) {
    return mean_curve(groups_of(rows).at(0), &Curves::pair_correlation).size();
  };
  const Row shorter = row_with_curves("a", {0, 2}, {1}),
            longer = row_with_curves("b", {0, 4, 5}, {2});
  CHECK(points({shorter, longer}) == 3);
  CHECK(points({longer, shorter}) == 3);
}

TEST_CASE("distances of the pair correlation are told in the unit of the sweep, too") {
  const std::vector<Row> rows = {row_with_curves("a", {0, 2}, {1})};
  const auto groups = analyse(rows).groups;
  const std::string text =
      text_of(distributions_table(varied_of(groups), Units{3.0, "mm", std::nullopt}), groups);
  CHECK(cell_in(text, 2, "curve") == "pair_correlation");
  CHECK(cell_in(text, 2, "low_mm") == "1.5");
  CHECK(cell_in(text, 2, "high_mm") == "3");
  CHECK(cell_in(text, 3, "curve") == "force_density");
  CHECK(cell_in(text, 3, "low_mm").empty());
}

TEST_CASE("a group without settled packings has no curves") {
  const std::vector<Row> rows = {row_with_status("u", 5, PackingStatus::failed, "no room")};
  CHECK(distributions_csv(analyse(rows).groups) == distributions_csv({}));
}

}  // namespace
}  // namespace grainsweep
