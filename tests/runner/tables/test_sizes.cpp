#include <catch2/catch.hpp>

#include "runner/tables/families.hpp"
#include "runner/tables/sizes.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

Row row_with_sizes(const std::string& id, std::vector<SizeRow> sizes) {
  Row row = settled_row(id, 5, 0.6, 6);
  row.outcome->result.sizes = std::move(sizes);
  return row;
}

TEST_CASE("sizes asked and packed stand side by side, with the scatter of the replicates") {
  const std::vector<Row> rows = {row_with_sizes("a", {{0.5, 0.25, 0.25, 0}, {2, 1, 1, 1}}),
                                 row_with_sizes("b", {{0.5, 0.25, 0.75, 0.5}, {2, 1, 1, 1}})};
  CHECK(sizes_csv(analyse(rows).groups) ==
        "group,family,job,label,width,boundary_y,small_share,diameter,asked,n,packed,packed_sd,"
        "packed_error,slab,slab_sd,slab_error\n"
        "1,MSP,a,MSP,5,walls,0,0.5,0.25,2,0.5,0.3535533905932738,1.6207191607090254,0.25,0."
        "3535533905932738,"
        "1.6207191607090254\n"
        "1,MSP,a,MSP,5,walls,0,2,1,2,1,0,0,1,0,0\n");
}

TEST_CASE("grains without a distribution, and groups without settled packings, have no rows") {
  const std::vector<Row> rows = {settled_row("a", 5, 0.6, 6),
                                 row_with_status("u", 5, PackingStatus::failed, "no room")};
  CHECK(sizes_csv(analyse(rows).groups) == sizes_csv({}));
}

TEST_CASE("a slab differs from its bed where chance would not make it differ as much") {
  const auto differs = [](const std::vector<double>& slab_shares, double packed = 0.1) {
    std::vector<Row> rows;
    for (const double share : slab_shares) {
      rows.push_back(
          row_with_sizes(std::to_string(rows.size()), {{0.5, 0.1, packed, share}, {2, 1, 1, 1}}));
    }
    const std::vector<Group> groups = analyse(rows).groups;
    const auto line = slab_difference(groups.front());
    return line && line->diameter == 0.5;
  };
  CHECK(differs({0.07, 0.071, 0.072}));
  CHECK(differs({0.13, 0.131, 0.132}));
  CHECK_FALSE(differs({0.095, 0.0951, 0.0952}));  // less than a tenth
  CHECK_FALSE(differs({0.07, 0.12, 0.05}));       // by chance
  CHECK_FALSE(differs({0.005, 0.0051}, 0.01));    // of next to no grains
  CHECK(differs({0.04}));                         // a single packing
  CHECK_FALSE(differs({0.07}));
}

TEST_CASE("the weight of a distribution is told by its parameters") {
  JobFacts job = sample_job("a", 5);
  CHECK_FALSE(has_size_distribution(job));
  job.parameters = R"({"sizes":{"distribution":{"by":"number"}}})";
  CHECK(has_size_distribution(job));
  CHECK(size_weight(job) == "number");
}

TEST_CASE("grains of a file have the sizes that stand there, not those of a distribution") {
  JobFacts job = sample_job("a", 5);
  const std::string sizes = R"("sizes":{"distribution":{"table":{"file":"0b"}}}})";
  job.parameters = R"({"fill":{"file":"0a"},)" + sizes;
  CHECK_FALSE(has_size_distribution(job));
  job.parameters = R"({"fill":{"files":["0a","0b"]},)" + sizes;
  CHECK_FALSE(has_size_distribution(job));
  job.parameters = R"({"fill":{"grains":500},)" + sizes;
  CHECK(has_size_distribution(job));
}

TEST_CASE("diameters have no noise of the division by the length that is d") {
  const std::vector<Row> rows = {row_with_sizes("a", {{22.4 / 20.0, 1, 1, 1}})};
  CHECK_THAT(sizes_csv(analyse(rows).groups), Catch::Contains(",1.12,1,1,"));
}

TEST_CASE("diameters are told in the units of the sweep, too") {
  const std::vector<Row> rows = {row_with_sizes("a", {{0.5, 1, 1, 1}})};
  const std::vector<Group> groups = analyse(rows).groups;
  const GivenUnits millimetres = Units{3.0, "mm", std::nullopt};
  const std::string text = text_of(sizes_table(varied_of(groups), millimetres), groups);
  CHECK_THAT(text, Catch::Contains("diameter_mm"));
  CHECK_THAT(text, Catch::Contains(",1.5"));
}

}  // namespace
}  // namespace grainsweep
