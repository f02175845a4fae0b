#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "bench/trade/comparison.hpp"

namespace grainsweep::bench {
namespace {

Setting setting_with(const std::string& preset, double cpu_seconds, double solid_fraction,
                     double coordination) {
  Setting setting;
  setting.preset = setting.name = preset;
  setting.parts = {{"preset", preset}, {"rest", "in_steps"}};
  for (int start = 1; start <= 4; ++start) {
    const double scatter = 0.001 * (start % 2 == 0 ? 1 : -1);
    setting.solid_fraction[start] = solid_fraction + 0.01 * start + scatter;
    setting.coordination[start] = coordination + start + scatter;
    setting.contact_ratio[start] = setting.force_square[start] = 1.0;
    setting.cpu_seconds.push_back(cpu_seconds);
  }
  setting.made = setting.settled = setting.planned = 4;
  return setting;
}

/// Layers beside a wall that decay over `length`, the same in every bed.
void add_layers(double length, Setting& setting) {
  setting.bin_width = 0.1;
  setting.half_gap = 5.0;
  for (int start = 1; start <= 4; ++start) {
    std::vector<double> side;
    for (int bin = 0; bin < 100; ++bin) {
      const double y = (bin + 0.5) * setting.bin_width;
      side.push_back(0.6 +
                     0.2 * std::exp(-y / length) * std::cos(2.0 * std::numbers::pi * y / 0.9));
    }
    setting.layers[start] = {side, side};
  }
}

Compared row_of(const Setting& setting, double cpu_seconds, double solid_fraction,
                double coordination) {
  Compared row;
  row.setting = &setting;
  row.made = setting.made;
  row.settled = setting.settled;
  row.cpu_seconds = cpu_seconds;
  row.solid_fraction = {solid_fraction, 0.0002, 64};
  row.coordination = {coordination, 0.003, 64};
  return row;
}

TEST_CASE("settings are compared with the first, start by start, and their cost with balanced") {
  Scene scene{"scene",
              {setting_with("exact", 8.0, 0.6, 6.0), setting_with("fast", 0.5, 0.59, 5.9),
               setting_with("balanced", 2.0, 0.595, 5.95)}};
  const std::vector<Compared> rows = compare_settings(scene);
  REQUIRE(rows.size() == 3);
  CHECK(rows[0].solid_fraction.mean == 0.0);
  CHECK(rows[1].solid_fraction.mean == Approx(-0.01).epsilon(1e-12));
  CHECK(rows[1].solid_fraction.error < 1e-15);  // what differs from start to start falls out
  CHECK(rows[2].coordination.mean == Approx(-0.05).epsilon(1e-12));
  CHECK(rows[1].relative_cost == 0.25);
  CHECK(rows[0].relative_cost == 4.0);
  CHECK(std::isnan(rows[1].lambda.mean));
}

TEST_CASE("a setting that was not made yet is left out") {
  Scene scene{"scene", {setting_with("exact", 8.0, 0.6, 6.0), Setting{}}};
  CHECK(compare_settings(scene).size() == 1);
}

TEST_CASE("layers that decay over another length differ by it in lambda") {
  Scene scene{"scene",
              {setting_with("exact", 8.0, 0.6, 6.0), setting_with("fast", 0.5, 0.59, 5.9)}};
  add_layers(1.3, scene.settings[0]);
  add_layers(1.1, scene.settings[1]);
  const std::vector<Compared> rows = compare_settings(scene);
  CHECK(rows[1].lambda.mean == Approx(-0.2).epsilon(1e-6));  // the fit ends at such steps
  CHECK(rows[1].lambda.error < 1e-6);                        // all beds have the same layers
}

TEST_CASE("a setting is beaten by a cheaper one that is nearer beyond two standard errors") {
  const Setting setting = setting_with("fast", 1.0, 0.6, 6.0);
  const Compared dear = row_of(setting, 1.0, 0.001, -0.05);
  CHECK(beats(row_of(setting, 0.9, 0.001, -0.02), dear));
  CHECK(beats(row_of(setting, 0.9, -0.001, 0.02), dear));
  CHECK_FALSE(beats(row_of(setting, 1.1, 0.001, -0.02), dear));   // dearer
  CHECK_FALSE(beats(row_of(setting, 0.9, 0.001, -0.048), dear));  // no nearer beyond the errors
  CHECK_FALSE(beats(row_of(setting, 0.9, 0.002, -0.02), dear));   // further in phi
}

TEST_CASE("a setting of which more do not settle beats none") {
  const Setting whole = setting_with("fast", 1.0, 0.6, 6.0);
  Setting part = whole;
  part.settled = 3;
  CHECK_FALSE(beats(row_of(part, 0.5, 0.0, 0.0), row_of(whole, 1.0, 0.001, -0.05)));
  CHECK(beats(row_of(whole, 0.5, 0.0, 0.0), row_of(part, 1.0, 0.001, -0.05)));
}

TEST_CASE("the front holds what nothing beats") {
  Scene scene{"scene",
              {setting_with("exact", 8.0, 0.6, 6.0), setting_with("fast", 0.5, 0.59, 5.9),
               setting_with("worse", 1.0, 0.58, 5.8), setting_with("best", 2.0, 0.599, 5.99)}};
  std::vector<bool> on_front;
  for (const Compared& row : compare_settings(scene)) on_front.push_back(row.on_front);
  CHECK(on_front == std::vector<bool>{true, true, false, true});
}

TEST_CASE("exact beds are set beside the same starts without the search for exact rest") {
  Scene scene{"scene",
              {setting_with("same", 8.0, 0.6, 6.0), setting_with("same", 1.0, 0.598, 5.9),
               setting_with("other", 1.0, 0.5, 5.0)}};
  scene.settings[0].parts["rest"] = "exact";
  const std::vector<ExactChange> changes = exact_changes(scene);
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].begins == &scene.settings[1]);
  CHECK(changes[0].solid_fraction.mean == Approx(0.002).epsilon(1e-12));
  CHECK(changes[0].coordination.mean == Approx(0.1).epsilon(1e-12));
}

}  // namespace
}  // namespace grainsweep::bench
