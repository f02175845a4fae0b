#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "runner/tables/component_profiles.hpp"
#include "runner/tables/families.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

constexpr auto along_y = &ComponentMeasure::profile_y;

/// Of two components, the second spheres; the second bin holds `grains` of the first, which touch 2
/// grains of their own, 3 of the other component and a wall each.
Row row_of_mixture(const std::string& id, double solid_fraction, std::int64_t grains) {
  Row row = polyhedra_row(id, 1);
  row.job.shape = "mixture";
  row.job.parameters = sample_mixture(1);
  const double none = no_number;
  auto& components = row.outcome->result.components;
  components.resize(2);
  components[0].profile_y = {0.5,
                             {{0.125, 0, {0, 0}, 0, {none, none, none}},
                              {solid_fraction,
                               grains,
                               {2 * grains, 3 * grains},
                               grains,
                               {0.25, 0.5, grains > 0 ? 1 : none}}}};
  components[1].profile_y = {
      0.5, {{0.25, 4, {8, 2}, 0, {none, none, none}}, {0, 0, {0, 0}, 0, {none, none, none}}}};
  return row;
}

TEST_CASE("a component's mean profile has mean and scatter of the replicates bin by bin") {
  const std::vector<Row> rows = {row_of_mixture("a", 0.25, 4), row_of_mixture("b", 0.75, 8)};
  const std::vector<Group> groups = analyse(rows).groups;
  const auto bins = mean_component_profile(groups[0], along_y, 0, 1);
  REQUIRE(bins.size() == 2);
  CHECK((bins[1].low == 0.5 && bins[1].high == 1));
  CHECK(bins[1].solid_fraction.mean == 0.5);
  CHECK(bins[1].solid_fraction.error == Approx(widened(0.25, 1)));
  CHECK(bins[1].neighbours.mean == 3);
  CHECK(mean_component_profile(groups[0], along_y, 0, 0)[1].neighbours.mean == 2);
  CHECK(bins[1].coordination.mean == 5);
  CHECK(bins[1].coordination_with_walls.mean == 6);
  CHECK(bins[1].nematic[1].mean == 0.5);
  CHECK(mean_component_profile(groups[0], along_y, 2, 0).empty());
}

TEST_CASE("replicates without grains of a component in a bin enter its solid fraction alone") {
  const std::vector<Row> rows = {row_of_mixture("a", 0.25, 4), row_of_mixture("b", 0.75, 0)};
  const std::vector<Group> groups = analyse(rows).groups;
  const auto bins = mean_component_profile(groups[0], along_y, 0, 1);
  CHECK((bins[0].solid_fraction.n == 2 && bins[0].neighbours.n == 0));
  CHECK(std::isnan(bins[0].coordination.mean));
  CHECK((bins[1].solid_fraction.n == 2 && bins[1].neighbours.n == 1));
  CHECK((bins[1].nematic[2].n == 1 && bins[1].nematic[2].mean == 1));
  CHECK(std::isnan(mean_component_profile(groups[0], along_y, 1, 0)[0].nematic[0].mean));
}

TEST_CASE("a bed that ends below a bin has no component there, but no order either") {
  Row low = row_of_mixture("a", 0.25, 4);
  for (ComponentMeasure& one : low.outcome->result.components) one.profile_y.bins.pop_back();
  const std::vector<Row> rows = {low, row_of_mixture("b", 0.75, 8)};
  const std::vector<Group> groups = analyse(rows).groups;
  const auto bins = mean_component_profile(groups[0], along_y, 0, 1);
  REQUIRE(bins.size() == 2);
  CHECK((bins[1].solid_fraction.n == 2 && bins[1].solid_fraction.mean == 0.375));
  CHECK((bins[1].neighbours.n == 1 && bins[1].coordination.n == 1));
  CHECK((bins[1].nematic[1].n == 1 && bins[1].nematic[1].mean == 0.5));
}

TEST_CASE("the table has a row for each bin of each pair of components") {
  const std::vector<Row> rows = {row_of_mixture("a", 0.25, 4)};
  const std::vector<Group> groups = analyse(rows).groups;
  const std::string text = text_of(component_profiles_table(varied_of(groups)), groups);
  REQUIRE(cells_of_table(text).size() == 9);
  CHECK(cell_in(text, 4, "component") == "1");
  CHECK(cell_in(text, 4, "other") == "2");
  CHECK(cell_in(text, 4, "component_shape") == "cube");
  CHECK(cell_in(text, 4, "other_shape") == "sphere");
  CHECK(cell_in(text, 4, "axis") == "y");
  CHECK(cell_in(text, 4, "low") == "0.5");
  CHECK(cell_in(text, 4, "from_axis") == "");
  CHECK(cell_in(text, 4, "neighbours") == "3");
  CHECK(cell_in(text, 4, "solid_fraction") == "0.25");
  CHECK(cell_in(text, 5, "component") == "2");
  CHECK(cell_in(text, 5, "coordination") == "2.5");
  CHECK(cell_in(text, 5, "nematic_x") == "");
}

TEST_CASE("grains of one shape have no profiles of components") {
  const std::vector<Row> rows = {polyhedra_row("a", 5),
                                 row_with_status("u", 5, PackingStatus::failed, "no room")};
  const std::vector<Group> groups = analyse(rows).groups;
  const CurveTable table = component_profiles_table(varied_of(groups));
  CHECK(text_of(table, groups) == table.header);
}

}  // namespace
}  // namespace grainsweep
