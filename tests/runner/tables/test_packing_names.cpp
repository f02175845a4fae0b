#include <catch2/catch.hpp>

#include "runner/tables/packing_names.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

TEST_CASE("packings of one label are told apart by what tells their families apart") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6),
                                 settled_row("b", 5, 0.6, 6, Boundary::walls, 0.25),
                                 settled_row("c", 6, 0.6, 6, Boundary::periodic, 0.25)};
  const PackingNames names(families_of(groups_of(rows)));
  CHECK(names.family_of(rows[1].job) == "MSP small_share=0.25");
  CHECK(names.set_of(rows[0].job) == "MSP small_share=0, W = 5");
  CHECK(names.set_of(rows[2].job) == "MSP small_share=0.25, W = 6 periodic");
}

TEST_CASE("packings that differ in width alone have no more than their labels and widths") {
  Row tube = settled_row("b", 7, 0.6, 6);
  tube.job.box.is_tube = true;
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), tube};
  const PackingNames names(families_of(groups_of(rows)));
  CHECK(names.set_of(rows[0].job) == "MSP, W = 5");
  CHECK(names.set_of(rows[1].job) == "MSP, D = 7");
  Row bare = rows[0];
  bare.job.label = "";
  CHECK(PackingNames().set_of(bare.job) == "W = 5");
}

TEST_CASE("a packing keeps its own label in a family of several") {
  Row open = settled_row("b", 6, 0.6, 6, Boundary::periodic);
  open.job.label = "open";
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6), open};
  const PackingNames names(families_of(groups_of(rows)));
  CHECK(names.set_of(rows[1].job) == "open, W = 6 periodic");
}

}  // namespace
}  // namespace grainsweep
