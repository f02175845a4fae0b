#include <catch2/catch.hpp>

#include "runner/tables/components.hpp"
#include "runner/tables/families.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

/// A packing of two components, the second of which has that solid fraction.
Row row_of_mixture(const std::string& id, double solid_fraction) {
  Row row = polyhedra_row(id, 5);
  row.job.shape = "mixture";
  row.job.parameters = sample_mixture(5);
  row.outcome->result.components = {
      {30, 10, 0.75, 0.75, 0.5, 6, 6.5, {4, 2}, {0.25, 0.25, 0.5}},
      {40, 20, 0.25, 0.25, solid_fraction, 5, 5, {1, 4}, {0.5, 0.5, 0.75}}};
  row.outcome->result.components[0].contacts = {{6, 2, 0}, {3, 1, 4}};
  row.outcome->result.components[1].contacts = {{3, 1, 4}, {0, 0, 0}};
  return row;
}

TEST_CASE("components have a line for each pair, with means over the replicates") {
  const std::vector<Row> rows = {row_of_mixture("a", 0.25), row_of_mixture("b", 0.75)};
  const std::vector<Group> groups = analyse(rows).groups;
  REQUIRE(groups.size() == 1);
  const std::vector<ComponentLine> lines = mean_components(groups[0]);
  REQUIRE(lines.size() == 4);
  CHECK((lines[1].component == 1 && lines[1].other == 2));
  CHECK(lines[1].neighbours.mean == 2);
  CHECK(lines[2].neighbours.mean == 1);
  CHECK(lines[3].solid_fraction.mean == 0.5);
  CHECK(lines[3].solid_fraction.n == 2);
  CHECK(lines[3].solid_fraction.error == Approx(widened(0.25, 1)));
  CHECK(lines[3].nematic[2].mean == 0.75);
  CHECK(lines[0].grains.mean == 30);
  CHECK(lines[0].coordination_with_walls.mean == 6.5);
}

TEST_CASE("contacts of two components are a share of all, and have kinds where there are any") {
  std::vector<Row> rows = {row_of_mixture("a", 0.25), row_of_mixture("b", 0.25)};
  rows[1].outcome->result.components[0].contacts = {{4, 0, 4}, {8, 0, 0}};
  rows[1].outcome->result.components[1].contacts = {{8, 0, 0}, {0, 0, 16}};
  const std::vector<Group> groups = analyse(rows).groups;
  const std::vector<ComponentLine> lines = mean_components(groups[0]);
  REQUIRE(lines.size() == 4);
  CHECK(lines[0].contacts.mean == 0.375);  // 8 of 16, 8 of 32
  CHECK(lines[0].contacts.error == Approx(widened(0.125, 1)));
  CHECK(lines[0].contact_kinds[0].mean == 0.625);  // 6 of 8, 4 of 8
  CHECK(lines[0].contact_kinds[1].mean == 0.125);
  CHECK(lines[1].contacts.mean == lines[2].contacts.mean);
  CHECK(lines[1].contact_kinds[2].mean == 0.25);  // 4 of 8, 0 of 8
  CHECK(lines[3].contacts.mean == 0.25);
  CHECK((lines[3].contact_kinds[2].mean == 1 && lines[3].contact_kinds[2].n == 1));
  CHECK(lines[0].contacts.mean + lines[1].contacts.mean + lines[3].contacts.mean == 1);
}

TEST_CASE("the table of components names what stands in it") {
  const std::vector<Row> rows = {row_of_mixture("a", 0.25)};
  const std::vector<Group> groups = analyse(rows).groups;
  const std::string text = text_of(components_table(varied_of(groups)), groups);
  CHECK_THAT(text, Catch::StartsWith("group,family,job,label,width,boundary_y,small_share,"
                                     "component,component_shape,other,other_shape,n,neighbours,"));
  CHECK_THAT(text,
             Catch::Contains(",5,walls,0,2,sphere,1,cube,1,1,"));  // 2 beside 1, of 1 packing, 1
}

TEST_CASE("grains of one shape have no components") {
  const std::vector<Row> rows = {polyhedra_row("a", 5),
                                 row_with_status("u", 5, PackingStatus::failed, "no room")};
  const std::vector<Group> groups = analyse(rows).groups;
  const CurveTable table = components_table(varied_of(groups));
  CHECK(text_of(table, groups) == table.header);
}

}  // namespace
}  // namespace grainsweep
