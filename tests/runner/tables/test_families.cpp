#include <catch2/catch.hpp>

#include "runner/tables/fits.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

TEST_CASE("groups that differ in width alone are a family, with the periodic one as reference") {
  const std::vector<Row> rows = {settled_row("a", 10, 0.62, 6), settled_row("b", 5, 0.6, 6),
                                 settled_row("c", 20, 0.64, 6, Boundary::periodic),
                                 settled_row("d", 20, 0.63, 6)};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 1);
  REQUIRE(families[0].walled.size() == 3);
  CHECK(families[0].name == "MSP");
  CHECK(families[0].walled[0].job.box.width == 5);
  CHECK(families[0].walled[2].job.box.width == 20);
  REQUIRE(families[0].periodic.size() == 1);
  CHECK(mean_of(families[0].unconfined.value(), "solid_fraction").mean == 0.64);
}

TEST_CASE(
    "of several boxes without walls the widest is the reference, in whatever order they come") {
  const std::vector<Row> rows = {settled_row("a", 20, 0.64, 6, Boundary::periodic),
                                 settled_row("b", 10, 0.63, 6, Boundary::periodic),
                                 settled_row("c", 5, 0.6, 6)};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 1);
  REQUIRE(families[0].periodic.size() == 2);
  CHECK(families[0].periodic[0].job.box.width == 10);
  CHECK(families[0].unconfined.value().job.box.width == 20);
}

TEST_CASE("families of one label are told apart by the parameter that differs") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6),
                                 settled_row("b", 5, 0.6, 6, Boundary::walls, 0.25),
                                 settled_row("c", 6, 0.6, 6)};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 2);
  CHECK(families[0].name == "MSP small_share=0");
  CHECK(families[1].name == "MSP small_share=0.25");
  CHECK(families[0].walled.size() == 2);
}

Row duct_row(double length, double width) {
  Row row = settled_row(std::to_string(length) + std::to_string(width), width, 0.6, 6);
  row.job.box.x = Boundary::walls;
  row.job.box.length = length;
  row.job.parameters = R"({"box":{"length":)" + std::to_string(length) + R"(,"width":)" +
                       std::to_string(width) + R"(,"x":"walls","y":"walls"}})";
  return row;
}

TEST_CASE("square ducts are a family, unless their lengths have other widths, too") {
  const std::vector<Row> squares = {duct_row(4, 4), duct_row(5, 5), duct_row(6, 6)};
  auto families = families_of(groups_of(squares));
  REQUIRE(families.size() == 1);
  CHECK(families[0].walled.size() == 3);
  CHECK(families[0].name == "MSP");
  CHECK(families[0].parameters == R"({"box":{"x":"walls"}})");
  const std::vector<Row> grid = {duct_row(4, 4), duct_row(4, 5), duct_row(5, 4), duct_row(5, 5)};
  families = families_of(groups_of(grid));
  REQUIRE(families.size() == 2);
  CHECK(families[0].name == "MSP length=4");
  CHECK(families[0].walled.size() == 2);
  const std::vector<Row> alone = {duct_row(4, 4)};
  CHECK(families_of(groups_of(alone))[0].parameters == R"({"box":{"length":4,"x":"walls"}})");
}

TEST_CASE("packings without walls along y take no square duct out of its family") {
  std::vector<Row> rows = {duct_row(4, 4), duct_row(5, 5), duct_row(6, 6), duct_row(4, 5)};
  rows.back().job.box.y = Boundary::periodic;
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 2);
  CHECK(families[0].walled.size() == 3);
  CHECK(families[1].periodic.size() == 1);
}

TEST_CASE("a family of two labels carries both") {
  Row narrow = settled_row("a", 4, 0.6, 6);
  narrow.job.label = "narrow";
  const std::vector<Row> rows = {settled_row("b", 5, 0.6, 6), narrow};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 1);
  CHECK(families[0].name == "narrow + MSP");
}

TEST_CASE("families that share only some labels are told apart, others are left alone") {
  Row more = settled_row("a", 6, 0.6, 6, Boundary::walls, 0.25);
  more.job.label = "more";
  Row alone = settled_row("b", 6, 0.6, 6, Boundary::walls, 0.5);
  alone.job.label = "alone";
  const std::vector<Row> rows = {settled_row("c", 5, 0.6, 6), alone, more,
                                 settled_row("d", 5, 0.6, 6, Boundary::walls, 0.25)};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 3);
  CHECK(families[0].name == "MSP small_share=0");
  CHECK(families[1].name == "alone");
  CHECK(families[2].name == "MSP + more small_share=0.25");
}

TEST_CASE("a preset stands as one word in a family's name") {
  Row fast = settled_row("a", 5, 0.6, 6), balanced = settled_row("b", 5, 0.6, 6);
  fast.job.accuracy = "fast";
  fast.job.parameters = R"({"accuracy":{"step":0.4,"momentum":0.5},"box":{"width":5}})";
  balanced.job.parameters = R"({"accuracy":{"step":0.2,"momentum":0.9},"box":{"width":5}})";
  const std::vector<Row> rows = {fast, balanced};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 2);
  CHECK(families[0].name == "MSP accuracy=fast");
  CHECK(families[1].name == "MSP accuracy=balanced");
}

TEST_CASE("a parameter that only some families have tells them apart") {
  Row with = settled_row("a", 5, 0.6, 6), without = settled_row("b", 5, 0.6, 6);
  with.job.parameters = R"({"box":{"width":5},"fill":{"grains":100}})";
  without.job.parameters = R"({"box":{"width":5}})";
  const std::vector<Row> rows = {with, without};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 2);
  CHECK(families[0].name == "MSP grains=100");
}

TEST_CASE("mixtures are told apart by the shares of their components, by the names of these") {
  std::vector<Row> rows = {mixture_row("a", 5), mixture_row("b", 5)};
  rows[1].job.parameters = sample_mixture(5, 0.5);
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 2);
  CHECK(families[0].name == "MSP cube=0.75 sphere=0.25");
  CHECK(families[1].name == "MSP cube=0.5 sphere=0.5");
}

TEST_CASE("tubes have the widest box without walls of the same grains as their reference") {
  std::vector<Row> rows = {settled_row("a", 5, 0.55, 6), settled_row("b", 7, 0.57, 6),
                           settled_row("c", 6, 0.63, 6, Boundary::periodic),
                           settled_row("d", 9, 0.64, 6, Boundary::periodic),
                           settled_row("e", 20, 0.7, 6, Boundary::periodic)};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    JobFacts& job = rows[k].job;
    const std::string side = std::to_string(job.box.width);
    const bool is_tube = k < 2, are_others = k == 4;
    if (is_tube) job.box = tube_of(job.box.width);
    if (!is_tube) job.box.length = job.box.width;
    const std::string container =
        is_tube ? R"("tube":{"diameter":)" + side + "}"
                : R"("box":{"length":)" + side + R"(,"width":)" + side + R"(,"y":"periodic"})";
    job.parameters = "{" + container + R"(,"fill":{"grains":)" + std::to_string(500 + k) +
                     R"(},"sizes":{"spread":)" + (are_others ? "0.1" : "0.0") + "}}";
  }
  for (Row& row : rows) row.job.box.x = row.job.box.is_tube ? Boundary::walls : Boundary::periodic;
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() >= 3);
  REQUIRE(families[0].walled.size() == 1);  // as fills differ
  for (const std::size_t tube : {0U, 1U}) {
    REQUIRE(families[tube].unconfined);
    CHECK(families[tube].unconfined->job.box.width == 9);
    CHECK(families[tube].periodic.empty());
  }
}

TEST_CASE("a periodic packing without a settled replicate is no reference") {
  Row row = row_with_status("a", 20, PackingStatus::not_settled, "moves");
  row.job.box.y = Boundary::periodic;
  const std::vector<Row> rows = {row};
  const auto families = families_of(groups_of(rows));
  REQUIRE(families.size() == 1);
  CHECK_FALSE(families[0].unconfined);
}

}  // namespace
}  // namespace grainsweep
