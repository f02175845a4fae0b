#include <catch2/catch.hpp>

#include "engine/dynamics/presets.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a preset is found by its name, and only by it") {
  for (const Preset& known : presets()) {
    CHECK(preset(known.name) == known.accuracy);
    CHECK_FALSE(known.promise.empty());
  }
  CHECK(preset("fast"));
  CHECK(preset("balanced") == Accuracy{});
  CHECK(preset("accurate"));
  CHECK_FALSE(preset(""));
  CHECK_FALSE(preset("Fast"));
}

TEST_CASE(
    "every preset at rest in steps asks for more than the one before it, and allows it more") {
  for (std::size_t k = 1; presets()[k].accuracy.rest == Rest::in_steps; ++k) {
    const Accuracy &coarse = presets()[k - 1].accuracy, &fine = presets()[k].accuracy;
    CHECK(fine.residual_tolerance < coarse.residual_tolerance);
    CHECK(fine.kinetic_tolerance < coarse.kinetic_tolerance);
    CHECK(fine.contact_tolerance < coarse.contact_tolerance);
    CHECK(fine.overlap_tolerance < coarse.overlap_tolerance);
    CHECK(fine.imbalance_tolerance < coarse.imbalance_tolerance);
    CHECK(fine.imbalance_gap <= coarse.imbalance_gap);
    CHECK(fine.path_tolerance <= coarse.path_tolerance);
    CHECK(fine.rest_iterations >= coarse.rest_iterations);
    CHECK(fine.creep_steps > coarse.creep_steps);
  }
}

TEST_CASE("the bias of a preset is bounded for each kind of bed that was measured") {
  for (std::size_t k = 0; k < bed_kinds; ++k) {
    const auto kind = static_cast<BedKind>(k);
    const bool are_spheres = kind != BedKind::pinacoids && kind != BedKind::narrow_pinacoids;
    for (const Preset& known : presets()) {
      if (known.accuracy.rest == Rest::exact && !are_spheres) continue;
      const auto bound = bias_bound(known.name, kind);
      REQUIRE(bound);
      CHECK(bound->solid_fraction > 0.0);
      CHECK(bound->solid_fraction < 0.01);
      CHECK(bound->coordination > 0.0);
      CHECK(bound->coordination < 0.2);
    }
    CHECK_FALSE(bias_bound("custom", kind));
  }
  CHECK_FALSE(bias_bound("exact", BedKind::pinacoids));
  CHECK_FALSE(bias_bound("exact", BedKind::narrow_pinacoids));
}

TEST_CASE("an accuracy settles as the preset that it is but for precision and most steps") {
  for (const Preset& known : presets()) {
    Accuracy accuracy = known.accuracy;
    CHECK(settles_as(accuracy) == known.name);
    accuracy.precision = Precision::f64;
    accuracy.max_steps = 77;
    CHECK(settles_as(accuracy) == known.name);
    accuracy.step /= 2.0;
    CHECK(settles_as(accuracy).empty());
  }
}

TEST_CASE("the last preset ends at exact rest") {
  CHECK(presets().back().name == "exact");
  CHECK(presets().back().accuracy.rest == Rest::exact);
}

TEST_CASE("every preset obeys the rules of a specification") {
  for (const Preset& known : presets()) {
    PackingSpec spec;
    spec.accuracy = known.accuracy;
    CHECK(check(spec).empty());
  }
}

}  // namespace
}  // namespace grainsweep
