#include <cmath>

#include <catch2/catch.hpp>

#include "runner/compare/wall_zone.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {
namespace {

/// Six large and four small grains a bin: `wall` neighbours each within `zone` of a wall, six
/// elsewhere.
Row zoned_row(const std::string& id, double width, double zone, std::int64_t wall,
              double bin_width = 0.1) {
  Row row = settled_row(id, width, 0.6, 6);
  Profile& profile = row.outcome->result.profile_y;
  profile.bin_width = bin_width;
  const auto bins = static_cast<int>(std::lround(width / bin_width));
  for (int k = 0; k < bins; ++k) {
    const double distance = std::min(k + 0.5, bins - k - 0.5) * bin_width;
    profile.bins.push_back({0.6, 0, 6, 4, 10 * (distance < zone ? wall : 6), 3});
  }
  return row;
}

TEST_CASE("a planted zone of fewer neighbours is found with its drop and width") {
  const std::vector<Row> rows = {zoned_row("a", 10, 1.5, 4), zoned_row("b", 10, 1.5, 4)};
  const auto groups = groups_of(rows);
  const WallZone zone = wall_zone(groups.at(0));
  REQUIRE(zone.not_determined.empty());
  CHECK(zone.drop.mean == Approx(2));
  CHECK(zone.width.mean == Approx(1.5));
  CHECK(zone.drop.n == 2);
}

// Of bins of 0.25 d the first two beside each wall have their middle in the layer at the wall, 0.6
// d thick, and the third has not.
TEST_CASE("a bin is in the layer at the wall if its middle is, at either wall") {
  const std::vector<Row> rows = {zoned_row("a", 10, 0.5, 4, 0.25),
                                 zoned_row("b", 10, 0.5, 4, 0.25)};
  const auto groups = groups_of(rows);
  const WallZone zone = wall_zone(groups.at(0));
  CHECK(zone.drop.mean == Approx(2));
  CHECK(zone.width.mean == Approx(0.5));
}

TEST_CASE("the error of a drop is the scatter of the packings") {
  const std::vector<Row> rows = {zoned_row("a", 10, 1.5, 4), zoned_row("b", 10, 1.5, 5)};
  const auto groups = groups_of(rows);
  CHECK(wall_zone(groups.at(0)).drop.mean == Approx(1.5));
  CHECK(wall_zone(groups.at(0)).drop.error == Approx(widened(0.5, 1)));
}

TEST_CASE("narrow gaps, periodic sides and single packings have no zone, and say why") {
  const auto reason = [](const std::vector<Row>& rows) {
    return wall_zone(groups_of(rows).at(0)).not_determined;
  };
  CHECK(reason({zoned_row("a", 5, 1, 4), zoned_row("b", 5, 1, 4)}) ==
        "needs a gap of 9 d or more between the walls, has 5");
  CHECK(reason({zoned_row("a", 9, 1, 4), zoned_row("b", 9, 1, 4)}) == "");
  CHECK(reason({zoned_row("a", 10, 1, 4)}) ==
        "needs 2 or more settled replicates to know the errors, has 1");
  Row periodic = settled_row("p", 10, 0.6, 6, Boundary::periodic);
  CHECK(reason({periodic, periodic}) == "there is no wall along y");
  Row empty = zoned_row("a", 10, 1, 4);
  for (ProfileBin& bin : empty.outcome->result.profile_y.bins) {
    bin.large_grains = bin.small_grains = 0;
  }
  CHECK(reason({empty, empty}) == "no grain lies at the wall or far off");
}

}  // namespace
}  // namespace grainsweep
