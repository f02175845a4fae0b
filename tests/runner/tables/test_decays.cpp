#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <catch2/catch.hpp>

#include "runner/tables/decays.hpp"
#include "runner/tables/families.hpp"
#include "tests/runner/sample_rows.hpp"
#include "tests/runner/tables/table_texts.hpp"

namespace grainsweep {
namespace {

/// A bed of large grains with layers at both walls that decay over 1.2 d, and some noise.
Row layered_row(const std::string& id, std::uint64_t seed, Boundary y = Boundary::walls) {
  Row row = settled_row(id, 10.0, 0.6, 6, y);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0, 0.002);
  Profile& profile = row.outcome->result.profile_y;
  profile.bin_width = 0.1;
  for (int k = 0; k < 100; ++k) {
    const double middle = (k + 0.5) * 0.1, from_wall = std::min(middle, 10 - middle);
    const double layers = 0.3 * std::exp(-from_wall / 1.2) * std::cos(7 * from_wall);
    profile.bins.push_back({0.6 + layers + normal(generator), 0, 5, 0, 0, 0});
  }
  return row;
}

TEST_CASE("the decay of a group comes from both walls of all its packings") {
  std::vector<Row> rows = {layered_row("a", 1), layered_row("b", 2), layered_row("c", 3)};
  const auto groups = groups_of(rows);
  const DecayFit fit = decay_of(groups.at(0), GrainClass::large);
  REQUIRE(fit.not_determined.empty());
  CHECK(std::abs(fit.length.value - 1.2) < 4 * fit.length.error);  // t with 2 degrees: 6 %
  CHECK(fit.length.error < 0.02);
  CHECK(fit.window_end == 5);
  // One wall spoilt: the fit must see it.
  for (Row& row : rows) {
    for (std::size_t k = 50; k < 100; ++k) row.outcome->result.profile_y.bins[k].large = 0.6;
  }
  const DecayFit half = decay_of(groups.at(0), GrainClass::large);
  CHECK((!half.not_determined.empty() || half.amplitude.value < 0.8 * fit.amplitude.value));
}

TEST_CASE("halves of a packing, which share grains, are one profile of its own") {
  std::vector<Row> rows = {layered_row("a", 1), layered_row("b", 2), layered_row("c", 3)};
  std::vector<std::vector<double>> profiles;
  for (Row& row : rows) {
    std::vector<ProfileBin>& bins = row.outcome->result.profile_y.bins;
    profiles.emplace_back();
    for (std::size_t k = 0; k < 50; ++k) {
      bins[99 - k].large = bins[k].large;  // halves that share all
      profiles.back().push_back(bins[k].large);
    }
  }
  const DecayFit fit = decay_of(groups_of(rows).at(0), GrainClass::large);
  const DecayFit expected = fit_decay(profiles, 0.1, 5.0);
  REQUIRE(fit.not_determined.empty());
  CHECK(fit.length.value == Approx(expected.length.value));
  CHECK(fit.length.error == Approx(expected.length.error));
  CHECK(fit.misfit == Approx(expected.misfit));
}

/// The same layers in a tube, from its wall to its axis.
Row layered_tube(const std::string& id, std::uint64_t seed) {
  Row row = layered_row(id, seed);
  row.job.box = tube_of(10);
  PackingResult& result = row.outcome->result;
  result.profile_from_walls = std::exchange(result.profile_y, {});
  result.profile_from_walls.bins.resize(50);
  return row;
}

// No bin is mirrored: what lies near the axis is not near a wall.
TEST_CASE("in a tube the profile from its wall is fitted as it is") {
  const std::vector<Row> rows = {layered_tube("a", 1), layered_tube("b", 2), layered_tube("c", 3)};
  std::vector<std::vector<double>> profiles;
  for (const Row& row : rows) {
    profiles.emplace_back();
    for (const ProfileBin& bin : row.outcome->result.profile_from_walls.bins) {
      profiles.back().push_back(bin.large);
    }
  }
  const DecayFit fit = decay_of(groups_of(rows).at(0), GrainClass::large);
  const DecayFit expected = fit_decay(profiles, 0.1, 5.0);
  REQUIRE(fit.not_determined.empty());
  CHECK(fit.length.value == expected.length.value);
  CHECK(fit.amplitude.value == expected.amplitude.value);
}

TEST_CASE("what the packings cannot tell is not determined, with the reason") {
  const auto reason = [](const std::vector<Row>& rows, GrainClass grains) {
    return decay_of(groups_of(rows).at(0), grains).not_determined;
  };
  const Row a = layered_row("a", 1), b = layered_row("b", 2);
  CHECK(reason({a}, GrainClass::large) ==
        "needs 2 or more settled replicates to know the errors, has 1");
  CHECK(reason({a, b}, GrainClass::small) == "there are no small grains");
  for (const bool is_first : {true, false}) {  // only one of the packings has some
    std::vector<Row> rows = {a, b};
    rows[is_first ? 0 : 1].outcome->result.profile_y.bins[7].small = 0.1;
    CHECK(reason(rows, GrainClass::small) ==
          "no small grains in the slab of 1 of 2 packings; larger beds hold some");
  }
  const auto periodic = Boundary::periodic;
  CHECK(reason({layered_row("a", 1, periodic), layered_row("b", 2, periodic)}, GrainClass::large) ==
        "there is no wall along y");
}

TEST_CASE("the table has two rows a group and no numbers where nothing is determined") {
  const std::vector<Row> rows = {layered_row("a", 1), layered_row("b", 2)};
  const std::string text = decays_csv(analyse(rows).groups);
  CHECK(text.starts_with(
      "group,family,job,label,width,boundary_y,small_share,class,status,reason,packings,window_"
      "start,"
      "window_end,bins,lambda,lambda_error,bulk,bulk_error,amplitude,amplitude_error,period,"
      "period_error,phase,phase_error,reach,reach_error,r_squared,misfit\n"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
  CHECK_THAT(text, Catch::Contains("\n1,MSP,a,MSP,10,walls,0,large,determined,,2,0.25,5,48,1."));
  CHECK_THAT(text,
             Catch::Contains("\n1,MSP,a,MSP,10,walls,0,small,not determined,there are no small "
                             "grains,2,0.25,5,0,,,,,,,,,,,,,,\n"));
}

TEST_CASE("a reach beyond the middle is no number of the table") {
  std::vector<Row> rows = {layered_row("a", 1), layered_row("b", 2)};  // 2.8 d
  for (Row& row : rows) {
    std::vector<ProfileBin>& bins = row.outcome->result.profile_y.bins;
    bins.erase(bins.begin() + 25, bins.end() - 25);
    row.job.box.width = 5.0;
  }
  const std::string text = decays_csv(analyse(rows).groups);
  const std::string line = text.substr(text.find(",large,determined,"));
  CHECK(std::count(line.begin(), line.begin() + line.find('\n'), ',') == 21);
  CHECK_THAT(line.substr(0, line.find('\n')), Catch::Matches(".*[0-9],,,0\\.[0-9]*,[0-9.]*"));
}

}  // namespace
}  // namespace grainsweep
