#include <cmath>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "runner/tables/families.hpp"
#include "runner/tables/profiles.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

/// Two bins; the second holds `grains` grains, a quarter of them small, with 6 neighbours each.
Row row_with_profile(const std::string& id, double large, std::int64_t grains) {
  Row row = settled_row(id, 1.0, 0.6, 6);
  ProfileBin filled{large, 0.125, grains - grains / 4, grains / 4, 6 * grains, grains};
  row.outcome->result.profile_y = {0.5, {{0.25, 0, 0, 0, 0, 0}, filled}};
  return row;
}

TEST_CASE("a mean profile has mean and scatter of the replicates bin by bin") {
  const std::vector<Row> rows = {row_with_profile("a", 0.25, 4), row_with_profile("b", 0.5, 8)};
  const auto groups = groups_of(rows);
  const auto bins = mean_profile(groups.at(0), &PackingResult::profile_y);
  REQUIRE(bins.size() == 2);
  CHECK(bins[1].low == 0.5);
  CHECK(bins[1].high == 1.0);
  CHECK(bins[1].large.mean == 0.375);
  CHECK(bins[1].large.sd == Approx(0.25 / std::sqrt(2.0)));
  CHECK(bins[1].solid_fraction.mean == 0.5);
  CHECK(bins[1].small.mean == 0.125);
  CHECK(bins[1].small.sd == 0);
  CHECK(bins[1].coordination.mean == 6);
  CHECK(bins[1].coordination_with_walls.mean == 7);
  CHECK(bins[1].small_number_share.mean == 0.25);
}

TEST_CASE("a bin without grains has a solid fraction but no coordination") {
  const std::vector<Row> rows = {row_with_profile("a", 0.25, 4), row_with_profile("b", 0.5, 0)};
  const auto groups = groups_of(rows);
  const auto bins = mean_profile(groups.at(0), &PackingResult::profile_y);
  CHECK(bins[0].solid_fraction.n == 2);
  CHECK(bins[0].coordination.n == 0);
  CHECK(std::isnan(bins[0].coordination.mean));
  CHECK(bins[1].coordination.n == 1);
}

TEST_CASE("nothing is solid above the highest grain of a bed that others are higher than") {
  Row low = settled_row("a", 5, 0.6, 6), high = settled_row("b", 5, 0.6, 6);
  low.outcome->result.profile_z = {1.0, {{0.5, 0, 1, 0, 0, 0}}};
  high.outcome->result.profile_z = {1.0, {{0.75, 0, 1, 0, 0, 0}, {0.25, 0, 1, 0, 0, 0}}};
  const std::vector<Row> rows = {low, high};
  const auto groups = groups_of(rows);
  const auto bins = mean_profile(groups.at(0), &PackingResult::profile_z);
  REQUIRE(bins.size() == 2);
  CHECK(bins[0].large.mean == 0.625);
  CHECK(bins[0].large.n == 2);
  CHECK(bins[1].large.mean == 0.125);
  CHECK(bins[1].large.n == 2);
  CHECK(bins[1].coordination.n == 1);
}

TEST_CASE("layers are whole numbers of bins, with the solid and the neighbours of all of them") {
  Row low = settled_row("a", 5, 0.6, 6), high = settled_row("b", 5, 0.6, 6);
  low.outcome->result.profile_z = {0.5, {{0.5, 0.25, 1, 2, 12, 3}, {0.25, 0, 1, 0, 6, 0}}};
  high.outcome->result.profile_z = {
      0.5, {{0.5, 0.25, 4, 0, 12, 0}, {0.5, 0, 0, 0, 0, 0}, {0.5, 0, 2, 0, 10, 1}}};
  const std::vector<Row> rows = {low, high};
  const auto groups = groups_of(rows);
  const auto layers = mean_layers(groups.at(0), &PackingResult::profile_z, 0.9);
  REQUIRE(layers.size() == 2);
  CHECK((layers[0].low == 0.0 && layers[0].high == 1.0 && layers[1].high == 2.0));
  CHECK(layers[0].solid_fraction.mean == (0.5 + 0.625) / 2);
  CHECK(layers[0].large.mean == (0.375 + 0.5) / 2);
  CHECK(layers[0].coordination.mean == (18.0 / 4 + 12.0 / 4) / 2);
  CHECK(layers[0].coordination_with_walls.mean == (21.0 / 4 + 12.0 / 4) / 2);
  CHECK(layers[1].solid_fraction.mean == (0.0 + 0.25) / 2);  // the half without a bin is empty
  CHECK(layers[1].coordination.mean == 5);
  const auto bins = mean_layers(groups.at(0), &PackingResult::profile_z, 0.1);
  CHECK(bins.size() == 3);
  CHECK(bins[1].solid_fraction.mean == 0.375);
}

TEST_CASE("a bed without a profile along an axis takes no part in its mean") {
  Row without = settled_row("a", 5, 0.6, 6), with = settled_row("b", 5, 0.6, 6);
  without.outcome->result.profile_z = {};
  with.outcome->result.profile_z = {1.0, {{0.5, 0, 1, 0, 0, 0}}};
  const std::vector<Row> rows = {without, with};
  const auto groups = groups_of(rows);
  const auto bins = mean_profile(groups.at(0), &PackingResult::profile_z);
  REQUIRE(bins.size() == 1);
  CHECK(bins[0].large.mean == 0.5);
  CHECK(bins[0].large.n == 1);
}

TEST_CASE("the table has a row per bin, axis and group, and unsettled packings leave no row") {
  Row unsettled = row_with_status("u", 7, PackingStatus::not_settled, "moves");
  unsettled.outcome->result.profile_y = {0.5, {{}}};
  const std::vector<Row> rows = {row_with_profile("a", 0.25, 4), unsettled};
  const std::string text = profiles_csv(analyse(rows).groups);
  REQUIRE(cells_of_table(text).size() == 3);
  CHECK_THAT(text,
             Catch::StartsWith("group,family,job,label,width,boundary_y,small_share,box.width,"
                               "axis,low,high,from_axis,n,coordination_n,solid_fraction,"
                               "solid_fraction_sd,solid_fraction_error,") &&
                 Catch::Contains("\n1,MSP,a,MSP,1,walls,0,1,y,0,0.5,,1,0,0.25,,,0.25,,,0,"));
  CHECK(cell_in(text, 1, "coordination").empty());
  CHECK(cell_in(text, 2, "coordination") == "6");
  CHECK(cell_in(text, 2, "coordination_with_walls") == "7");
  CHECK(cell_in(text, 2, "small_number_share") == "0.25");
}

TEST_CASE("a duct has profiles along x and from its nearest wall, too") {
  Row row = row_with_profile("a", 0.25, 4);
  row.outcome->result.profile_x = row.outcome->result.profile_y;
  row.outcome->result.profile_from_walls = row.outcome->result.profile_y;
  const std::vector<Row> rows = {row};
  const std::string text = profiles_csv(groups_of(rows));
  CHECK(cells_of_table(text).size() == 7);
  CHECK(cell_in(text, 2, "axis") == "x");
  CHECK(cell_in(text, 3, "axis") == "y");
  CHECK(cell_in(text, 5, "axis") == "walls");
  CHECK(cell_in(text, 5, "from_axis") == "");
}

TEST_CASE("the profile of a tube says how far its bins are from the axis") {
  Row row = row_with_profile("a", 0.25, 4);
  row.job.box = tube_of(6);
  row.outcome->result.profile_from_walls = std::exchange(row.outcome->result.profile_y, {});
  const std::vector<Row> rows = {row};
  const std::string text = profiles_csv(groups_of(rows));
  CHECK(cell_in(text, 1, "axis") == "walls");
  CHECK(std::stod(cell_in(text, 1, "low")) == 0.0);
  const double high = std::stod(cell_in(text, 1, "high"));
  CHECK(std::stod(cell_in(text, 1, "from_axis")) == Approx(3 - high / 2));
  row.outcome->result.profile_z = row.outcome->result.profile_from_walls;
  const std::vector<Row> with_z = {row};
  const std::string upright = profiles_csv(groups_of(with_z));
  CHECK(cell_in(upright, 3, "axis") == "z");
  CHECK(cell_in(upright, 3, "from_axis").empty());  // a height has no distance from it
}

}  // namespace
}  // namespace grainsweep
