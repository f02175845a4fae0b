#include <algorithm>

#include <catch2/catch.hpp>

#include "bench/trade/tables.hpp"

namespace grainsweep::bench {
namespace {

using Catch::Contains;

Setting preset_with(const std::string& name, double solid_fraction, double coordination) {
  Setting setting;
  setting.preset = setting.name = name;
  setting.parts = {{"preset", name == "exact" ? "begun" : name},
                   {"rest", name == "exact" ? "exact" : "in_steps"}};
  for (int start = 1; start <= 2; ++start) {
    setting.solid_fraction[start] = solid_fraction;
    setting.coordination[start] = coordination;
    setting.contact_ratio[start] = 0.995;
    setting.force_square[start] = 1.5;
  }
  setting.made = setting.settled = setting.planned = 2;
  setting.cpu_seconds = {2.0, 4.0};
  return setting;
}

Scene small_scene() {
  Scene scene{"a scene", {preset_with("exact", 0.6, 6.0), preset_with("balanced", 0.5985, 5.9)}};
  scene.settings[1].bound = ProtocolBias{0.002, 0.05};
  return scene;
}

std::string markdown_of(const Scene& scene) {
  return trade_markdown({&scene, compare_settings(scene)});
}

TEST_CASE("a difference has a sign, its error, and a dash where there is none") {
  CHECK(difference_text({0.00123, 0.0002, 64}, 5) == "+0.00123 +- 0.00020");
  CHECK(difference_text({-0.05, 0.003, 64}, 3) == "-0.050 +- 0.003");
  CHECK(difference_text(paired_difference({}, {}), 3) == "-");
}

TEST_CASE("the tables tell reference, certificates, differences and bounds that do not hold") {
  const std::string text = markdown_of(small_scene());
  CHECK_THAT(text, Contains("Reference: `exact`, phi = 0.6000, Z = 6.000"));
  CHECK_THAT(text, Contains("2 of 2 beds are certified"));
  CHECK_THAT(text, Contains("| **balanced** | 2 | 2 of 2 | 3.00 | 1.00 | -0.00150 +- 0.00000 | "
                            "-0.1000 +- 0.0000 | - | +0.000 +- 0.000 | 0.9950 | front |"));
  CHECK_THAT(text, Contains("| `balanced` | -0.00150 +- 0.00000 | 0.0020 | "
                            "-0.1000 +- 0.0000 | 0.050 | no |"));
  CHECK_THAT(text, !Contains("not finished"));
}

TEST_CASE("a bound that holds is said to hold") {
  Scene scene = small_scene();
  scene.settings[1].bound = ProtocolBias{0.002, 0.11};
  CHECK_THAT(markdown_of(scene), Contains("| 0.110 | yes |"));
  scene.settings[0].bound = ProtocolBias{0.001, 0.01};
  CHECK_THAT(markdown_of(scene), !Contains("| `exact` |"));  // it is what the others differ from
}

TEST_CASE("exact beds stand beside those they began from") {
  Scene scene = small_scene();
  scene.settings[1].parts["preset"] = "begun";
  CHECK_THAT(markdown_of(scene), Contains("| `balanced` | 2 of 2 | 2 | "
                                          "+0.00150 +- 0.00000 | +0.1000 +- 0.0000 |"));
}

TEST_CASE("a scene without bounds and exact beds has no table of them") {
  Scene scene = small_scene();
  scene.settings[1].bound.reset();
  CHECK_THAT(markdown_of(scene), !Contains("bound") && !Contains("What the search"));
}

TEST_CASE("a scene that is not whole says so") {
  Scene scene = small_scene();
  scene.settings[1].planned = 5;
  CHECK_THAT(markdown_of(scene), Contains("not finished: 4 of 7 packings are made"));
}

TEST_CASE("the table of the picture has a line for each setting, under its columns") {
  Scene scene = small_scene();
  scene.settings[0].solid_fraction = {{1, 0.75}, {2, 0.75}};
  scene.settings[1].solid_fraction = {{1, 0.5}, {2, 0.5}};
  const std::string text = trade_csv({&scene, compare_settings(scene)});
  CHECK_THAT(text, Contains("scene,accuracy,preset,starts,made,settled,cpu_seconds,"));
  CHECK_THAT(text, Contains("\na scene,balanced,balanced,2,2,2,3,1,-0.25,0,-0."));
  CHECK(std::count(text.begin(), text.end(), '\n') == 3);
}

}  // namespace
}  // namespace grainsweep::bench
