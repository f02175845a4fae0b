#include <algorithm>

#include <catch2/catch.hpp>

#include "runner/tables/families.hpp"
#include "runner/tables/packings.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

Row with_two_tolerances(Row row) {
  row.job.measure.gap_tolerances = {1e-4, 1e-5};
  return row;
}

const std::string whole_header =
    "job,label,replicate,seed,shape,grains,width,boundary_y,small_share,status,solid_"
    "fraction,"
    "coordination,coordination_with_walls,contacts,isostatic_contacts,contact_ratio,overlap_mean,"
    "overlap_max,"
    "static_imbalance_mean,static_imbalance_max,step_residual,kinetic_energy,steps,iterations,cpu_"
    "seconds,length,boundary_x,accuracy,"
    "gap_tolerance,coordination_at_1e-05,coordination_with_walls_at_1e-05,surface_height,"
    "slab_bottom,slab_top,independent_contacts,largest_motion,spurious_path,slab_small_share,"
    "bed_small_share,mean_diameter,mean_diameter_by_volume,sauter_diameter,q6_global,q6_local,"
    "three_contact_share,"
    "segregation,"
    "force_mean,force_square,state_hash,reason,contacts_simple,contacts_double,contacts_triple,"
    "force_simple,force_double,force_triple,nematic_x,nematic_y,nematic_z,start,group,family\n";

std::string csv_of(const std::vector<Row>& rows) {
  return packings_csv(rows, analyse(rows).groups);
}

/// What spheres have in the columns of shapes.
const std::string no_shape = ",,,,,,,,,";

TEST_CASE("a settled packing is written with every value") {
  CHECK(
      csv_of({with_two_tolerances(settled_row("a1", 5, 0.6125, 5.75))}) ==
      whole_header +
          "a1,MSP,1,7,sphere,2000,5,walls,0,settled,0.6125,5.75,6,5990,5991,0.99983308295777,"
          "8e-05,3e-04,0.02,0."
          "25,5e-04,"
          "1e-09,265,20000,0.75,20,periodic,balanced,1e-04,5.625,5.75,15.5,3,12.5,5990,2e-05,0,0,,"
          "0.98,0.99,0.985,0.03,0.4,0.1,,5.5,1.6,abcdef0123456789," +
          no_shape + ",,1,MSP\n");
}

TEST_CASE("an unsettled packing keeps its values beside its status and reason") {
  const Row row =
      with_two_tolerances(row_with_status("a1", 5, PackingStatus::not_settled, "moves, still"));
  const std::string text = csv_of({row});
  CHECK_THAT(text, Catch::Contains(",not_settled,0.5,5,5.25,"));
  CHECK_THAT(text, Catch::EndsWith(",\"moves, still\"" + no_shape + ",,1,MSP\n"));
}

TEST_CASE("shapes have their order at the end of the row, pending ones nothing") {
  Row row = with_two_tolerances(polyhedra_row("a1", 5));
  CHECK_THAT(csv_of({row}), Catch::Contains("a1,MSP,1,7,pinacoid,2000,5,") &&
                                Catch::EndsWith(",abcdef0123456789,,0.5,0.25,0.25,0.25,0.25,"
                                                "0.5,0.125,0.0625,0.75,,1,MSP\n"));
  row.outcome.reset();
  CHECK_THAT(csv_of({row}), Catch::EndsWith("," + no_shape + ",,1,MSP\n"));
}

TEST_CASE("failed and pending packings have no numbers where nothing was measured") {
  Row pending = with_two_tolerances(settled_row("a2", 6, 0.6, 6));
  pending.outcome.reset();
  const Row failed =
      with_two_tolerances(row_with_status("a1", 5, PackingStatus::failed, "no room"));
  const std::string text = csv_of({failed, pending});
  CHECK(cell_in(text, 1, "reason") == "no room");
  CHECK(cell_in(text, 1, "steps") == "265");
  CHECK(cell_in(text, 2, "status") == "pending");
  CHECK(cell_in(text, 2, "steps").empty());
  for (const char* const measured : {"solid_fraction", "coordination", "contact_ratio",
                                     "slab_small_share", "coordination_at_1e-05", "state_hash"}) {
    CHECK((cell_in(text, 1, measured).empty() && cell_in(text, 2, measured).empty()));
  }
}

TEST_CASE("what a sweep varies has a column under its dotted name, in packings and groups") {
  Row file = settled_row("a2", 5, 0.6, 6);
  file.job.parameters = R"({"box":{"width":5},"fill":{"file":"07abc8e11d0933c0"},"only":[1,2]})";
  file.job.files["fill.file"] = "start, two.csv";
  Row other = settled_row("a1", 5, 0.6, 6);
  other.job.parameters = R"({"box":{"width":5},"fill":{"solid_height":9.95}})";
  const std::vector<Row> rows = {other, file};
  const auto groups = analyse(rows).groups;
  for (const std::string& text : {packings_csv(rows, groups), groups_csv(groups)}) {
    CHECK(cell_in(text, 1, "fill.solid_height") == "9.95");
    CHECK(cell_in(text, 2, "fill.solid_height").empty());
    CHECK(cell_in(text, 2, "fill.file") == "\"start, two.csv\"");
    CHECK(cell_in(text, 2, "only") == "\"[1,2]\"");
    CHECK(cell_in(text, 2, "group") == "2");
    CHECK_THAT(text, !Catch::Contains("box.width"));
  }
}

TEST_CASE("every row has as many cells as the header, whatever tolerances its job has") {
  Row other = settled_row("a2", 6, 0.6, 6);
  other.job.measure.gap_tolerances = {1e-5, 1e-4};
  const std::string text = csv_of({with_two_tolerances(settled_row("a1", 5, 0.6, 6)), other});
  std::size_t begin = 0;
  for (int line = 0; line < 3; ++line) {
    const std::size_t end = text.find('\n', begin);
    CHECK(std::count(text.begin() + static_cast<long>(begin), text.begin() + static_cast<long>(end),
                     ',') == 64);
    begin = end + 1;
  }
}

}  // namespace
}  // namespace grainsweep
