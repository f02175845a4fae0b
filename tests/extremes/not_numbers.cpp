#include <limits>

#include "engine/scene/start.hpp"
#include "engine/units.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/packed.hpp"

namespace grainsweep::extremes {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

PackingSpec placed(const PlacedSphere& odd) {
  PackingSpec spec = small_spec(1, at_preset("balanced").accuracy);
  spec.fill = PlacedGrains{{{1, 2, 0.5, 0.5}, odd, {3, 2, 3, 0.5}}};
  return spec;
}

Scene refused(const std::string& name, const std::string& extreme, const PackingSpec& spec) {
  return {"not numbers", name, extreme, "balanced", Outcome::refused, [=] { return pack(spec); }};
}

/// The check left out, as if a rule were missing: the engine itself must say what happened.
Scene failed(const std::string& name, const std::string& extreme, const PackingSpec& spec) {
  return {"not numbers", name + ", unchecked", extreme,
          "balanced",    Outcome::refused,     [=] { return pack_unchecked(spec); }};
}

template <class Change>
PackingSpec changed(Change change) {
  PackingSpec spec = small_spec(60, at_preset("balanced").accuracy);
  change(spec);
  return spec;
}

void add_places(std::vector<Scene>& scenes) {
  for (const double value : {nan, infinity, -infinity}) {
    const std::string text = value != value ? "NaN" : value > 0 ? "infinity" : "-infinity";
    scenes.push_back(refused("a grain's x", text, placed({value, 2, 2, 0.5})));
    scenes.push_back(refused("a grain's height", text, placed({2, 2, value, 0.5})));
    scenes.push_back(refused("a grain's radius", text, placed({2, 2, 2, value})));
  }
  scenes.push_back(refused("a grain's height", "1e300 d", placed({2, 2, 1e300, 0.5})));
  scenes.push_back(refused("a grain's radius", "0", placed({2, 2, 2, 0})));
  scenes.push_back(failed("a grain's x", "NaN", placed({nan, 2, 2, 0.5})));
  scenes.push_back(failed("a grain's height", "NaN", placed({2, 2, nan, 0.5})));
  scenes.push_back(failed("a grain's radius", "NaN", placed({2, 2, 2, nan})));
  scenes.push_back(failed("a grain's height", "infinity", placed({2, 2, infinity, 0.5})));
}

/// A random bed of 60 grains, and a grain of dust above it.
PackingSpec with_dust(double radius) {
  PackingSpec spec = small_spec(60, at_preset("balanced").accuracy);
  const SphereBed bed = *start<Sphere>(spec);
  PlacedGrains fill{{{2, 2, 30, radius}}};
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& p = bed.position[i];
    fill.grains.push_back({p.x, p.y, p.z, p.w});
  }
  spec.fill = fill;
  return spec;
}

/// Radii so small that masses leave the range of the number type.
void add_dust(std::vector<Scene>& scenes) {
  for (const char* radius : {"1e-3", "1e-6", "1e-13", "1e-15", "1e-40", "1e-110", "1e-300"}) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      PackingSpec spec = with_dust(std::stod(radius));
      spec.accuracy.precision = precision;
      const bool representable = precision == Precision::f64 && std::stod(radius) > 1e-100;
      scenes.push_back({"not numbers", "a grain of dust", std::string("radius ") + radius + " d",
                        precision == Precision::f32 ? "balanced, f32" : "balanced, f64",
                        representable ? Outcome::right : Outcome::refused,
                        [spec] { return pack(spec); }});
    }
  }
}

void add_boxes(std::vector<Scene>& scenes) {
  for (const double value : {nan, infinity, 0.0, -4.0}) {
    const std::string text = value != value ? "NaN"
                             : value > 1    ? "infinity"
                             : value < 0    ? "-4 d"
                                            : "0";
    scenes.push_back(
        refused("the box's length", text, changed([=](PackingSpec& s) { s.box.length = value; })));
    scenes.push_back(
        refused("the box's width", text, changed([=](PackingSpec& s) { s.box.width = value; })));
    scenes.push_back(
        refused("the step", text, changed([=](PackingSpec& s) { s.accuracy.step = value; })));
  }
  scenes.push_back(
      refused("the spread of sizes", "NaN", changed([](PackingSpec& s) { s.sizes.spread = nan; })));
  scenes.push_back(refused("the solid height", "infinity",
                           changed([](PackingSpec& s) { s.fill = SolidHeight{infinity}; })));
  scenes.push_back(refused("the residual tolerance", "NaN",
                           changed([](PackingSpec& s) { s.accuracy.residual_tolerance = nan; })));
  scenes.push_back(refused("the residual tolerance", "infinity", changed([](PackingSpec& s) {
                             s.accuracy.residual_tolerance = infinity;
                           })));
  scenes.push_back(
      refused("the momentum", "1", changed([](PackingSpec& s) { s.accuracy.momentum = 1.0; })));
}

}  // namespace

std::vector<Scene> not_numbers() {
  std::vector<Scene> scenes;
  add_places(scenes);
  add_dust(scenes);
  add_boxes(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
