#include <cmath>

#include <catch2/catch.hpp>

#include "bench/trade/pool.hpp"
#include "bench/trade/tables.hpp"
#include "runner/store/files.hpp"
#include "runner/tables/csv.hpp"
#include "tests/runner/temporary_folder.hpp"

namespace grainsweep::bench {
namespace {

using Catch::Contains;

/// Beds of starts 1 to `beds`, whose values scatter about these, evenly up and down.
Setting setting_with(const std::string& name, double solid_fraction, int beds) {
  Setting setting;
  setting.preset = setting.name = name;
  setting.parts = {{"preset", name}, {"rest", "in_steps"}};
  for (int start = 1; start <= beds; ++start) {
    const double scatter = name == "accurate" ? 0.0 : start % 2 == 0 ? 0.01 : -0.01;
    setting.solid_fraction[start] = solid_fraction + scatter;
    setting.coordination[start] = 6.0 + scatter;
    setting.contact_ratio[start] = setting.force_square[start] = 1.0;
    setting.cpu_seconds.push_back(solid_fraction);
  }
  setting.made = setting.settled = setting.planned = beds;
  return setting;
}

Scene scene_of(std::uint64_t seed, double balanced, int beds) {
  return {"a scene",
          {setting_with("accurate", 0.6, beds), setting_with("balanced", balanced, beds)},
          seed};
}

std::vector<Compared> pooled_rows(const std::string& path, const Scene& scene) {
  std::vector<Compared> rows = compare_settings(scene);
  pool_with(path, scene, rows);
  return rows;
}

TEST_CASE("means of two runs weigh by their pairs, and their errors as those of one run of both") {
  const MeanError both = pooled({1.0, 0.3, 4}, {4.0, 0.1, 2});
  CHECK(both.n == 6);
  CHECK(both.mean == 2.0);
  CHECK(both.error == Approx(std::sqrt(1.2 * 1.2 + 0.2 * 0.2) / 6.0).epsilon(1e-14));
}

TEST_CASE("a run without pairs adds nothing") {
  const MeanError one{1.0, 0.3, 4}, none{no_number, no_number, 0};
  CHECK(pooled(one, none).mean == 1.0);
  CHECK(pooled(none, one).error == 0.3);
  CHECK(pooled(none, none).n == 0);
}

TEST_CASE("rows of another seed join those of the file") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  const Scene first = scene_of(1, 0.5, 4), second = scene_of(2, 0.53, 2);
  CHECK(pooled_rows(path, first)[1].solid_fraction.mean == Approx(-0.1).epsilon(1e-12));
  const std::vector<Compared> rows = pooled_rows(path, second);
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].solid_fraction.n == 6);
  CHECK(rows[1].solid_fraction.mean == Approx((4 * -0.1 + 2 * -0.07) / 6).epsilon(1e-12));
  CHECK(rows[1].settled == 6);
  CHECK(rows[1].made == 6);
  CHECK(rows[1].own_solid_fraction.mean == Approx((4 * 0.5 + 2 * 0.53) / 6).epsilon(1e-12));
  CHECK(rows[1].cpu_seconds == Approx((4 * 0.5 + 2 * 0.53) / 6).epsilon(1e-12));
  CHECK(rows[0].solid_fraction.mean == 0.0);
  CHECK(rows[0].own_solid_fraction.mean == Approx(0.6).epsilon(1e-12));
  CHECK(std::isnan(rows[1].lambda.mean));  // there are no walls
  CHECK_THAT(trade_markdown({&second, rows}), Contains("| **balanced** | 6 | 6 of 6 |"));
}

TEST_CASE("a seed that is stored again takes the place of its earlier rows") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  pooled_rows(path, scene_of(1, 0.5, 2));
  pooled_rows(path, scene_of(2, 0.53, 2));
  const std::vector<Compared> rows = pooled_rows(path, scene_of(1, 0.5, 4));
  CHECK(rows[1].solid_fraction.n == 6);
  CHECK(rows[1].solid_fraction.mean == Approx((4 * -0.1 + 2 * -0.07) / 6).epsilon(1e-12));
}

TEST_CASE("where the reference has more starts than a row, means of all beds are compared") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  Scene more{"a scene", {setting_with("accurate", 0.63, 8)}, 3};
  for (auto& [start, value] : more.settings[0].solid_fraction) value += start > 4 ? 0.02 : -0.02;
  pooled_rows(path, more);
  const Scene paired = scene_of(1, 0.5, 4);
  pooled_rows(path, paired);
  const std::vector<Compared> rows = pooled_rows(path, scene_of(2, 0.5, 4));
  CHECK(rows[0].own_solid_fraction.n == 16);
  CHECK(rows[0].own_solid_fraction.mean == Approx(0.615).epsilon(1e-12));
  CHECK(rows[0].solid_fraction.mean == 0.0);
  CHECK(rows[1].solid_fraction.n == 8);
  CHECK(rows[1].solid_fraction.mean == Approx(0.5 - 0.615).epsilon(1e-12));
  // Of 8 beds 0.02 from their mean the error is sqrt(0.02^2 / 7), weighed by half of all; that of
  // two times 4 beds 0.01 from theirs is sqrt(0.01^2 / 3) in each, and weighed by half.
  const double reference = 0.5 * std::sqrt(0.0004 / 7.0), own = std::sqrt(0.0001 / 3.0 / 2.0);
  CHECK(rows[1].solid_fraction.error == Approx(std::hypot(reference, own)).epsilon(1e-12));
  CHECK_THAT(trade_markdown({&paired, rows}),
             Contains("these are of 16 starts, and rows of fewer"));
}

TEST_CASE("an accuracy that the file does not have stands by itself") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  Scene other = scene_of(1, 0.5, 4);
  other.settings[1].name = "balanced, step 0.1";
  pooled_rows(path, other);
  CHECK(pooled_rows(path, scene_of(2, 0.53, 2))[1].solid_fraction.n == 2);
}

TEST_CASE("rows of one start each are pooled, though a single one has no error") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  pooled_rows(path, scene_of(1, 0.5, 1));
  const std::vector<Compared> rows = pooled_rows(path, scene_of(2, 0.53, 1));
  CHECK(rows[1].solid_fraction.n == 2);
  CHECK(std::isnan(rows[1].solid_fraction.error));
}

TEST_CASE("seeds of which no bed settles with an accuracy are pooled with others") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  const auto none_settled = [](std::uint64_t seed) {
    Scene scene = scene_of(seed, 0.5, 2);
    Setting& balanced = scene.settings[1];
    for (auto* values : {&balanced.solid_fraction, &balanced.coordination, &balanced.contact_ratio,
                         &balanced.force_square})
      values->clear();
    balanced.settled = 0;
    return scene;
  };
  pooled_rows(path, none_settled(1));
  const std::vector<Compared> rows = pooled_rows(path, scene_of(2, 0.53, 2));
  CHECK(rows[1].made == 4);
  CHECK(rows[1].settled == 2);
  CHECK(rows[1].contact_ratio == Approx(1.0));
  CHECK(rows[1].own_solid_fraction.mean == Approx(0.53));
  CHECK(rows[1].solid_fraction.n == 2);
  CHECK(pooled_rows(path, none_settled(3))[1].own_solid_fraction.mean == Approx(0.53));
}

TEST_CASE("a file of another scene, or of another kind, is refused and stays") {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/pool.json";
  pooled_rows(path, scene_of(1, 0.5, 2));
  const std::string before = read_file(path);
  Scene other = scene_of(2, 0.5, 2);
  other.name = "another";
  CHECK_THROWS_WITH(pooled_rows(path, other), Contains("is of \"a scene\", not of \"another\""));
  CHECK(read_file(path) == before);
  replace_file(path, "[]");
  CHECK_THROWS_WITH(pooled_rows(path, other), Contains("is no file of rows by seed"));
}

}  // namespace
}  // namespace grainsweep::bench
