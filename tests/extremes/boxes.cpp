#include <utility>

#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/packed.hpp"

namespace grainsweep::extremes {

namespace {

Scene packing(const char* name, const char* extreme, const char* preset_name, Outcome expected,
              void (*change)(PackingSpec&)) {
  PackingSpec spec = small_spec(60, at_preset(preset_name).accuracy);
  change(spec);
  return {"boxes", name, extreme, preset_name, expected, [spec] { return pack(spec); }};
}

/// Grains of one size between walls `width` apart.
void one_layer(PackingSpec& spec, double width) {
  spec.box.width = width;
  spec.box.length = 6;
  spec.sizes.spread = 0;
  spec.fill = GrainCount{40};
}

void add_counts(std::vector<Scene>& scenes) {
  scenes.push_back(packing("no grain", "n = 0", "balanced", Outcome::refused,
                           [](PackingSpec& s) { s.fill = GrainCount{0}; }));
  scenes.push_back(packing("one grain", "n = 1", "balanced", Outcome::refused,
                           [](PackingSpec& s) { s.fill = GrainCount{1}; }));
  scenes.push_back(packing("two grains", "n = 2", "balanced", Outcome::refused,
                           [](PackingSpec& s) { s.fill = GrainCount{2}; }));
  scenes.push_back(packing("three grains", "n = 3", "accurate", Outcome::refused,
                           [](PackingSpec& s) { s.fill = GrainCount{3}; }));
  scenes.push_back(packing("one grain, measured above the floor zone", "n = 1, slab of no height",
                           "fast", Outcome::refused, [](PackingSpec& s) {
                             s.fill = GrainCount{1};
                             s.measure.exclude_floor = 3;
                           }));
}

void add_widths(std::vector<Scene>& scenes) {
  for (const char* name : {"fast", "balanced", "accurate"}) {
    // A layer of equal grains is no generic bed: its contacts need not be as many as isostatic.
    const Outcome layer = name == std::string("fast") ? Outcome::right : Outcome::not_settled;
    scenes.push_back(packing("one layer", "W = d exactly", name, layer,
                             [](PackingSpec& s) { one_layer(s, 1); }));
    scenes.push_back(packing("one layer and no more", "W = d + 1e-12", name, layer,
                             [](PackingSpec& s) { one_layer(s, 1 + 1e-12); }));
    scenes.push_back(packing("one layer and a half", "W = 1.5 d", name, layer,
                             [](PackingSpec& s) { one_layer(s, 1.5); }));
  }
  scenes.push_back(packing("too narrow by rounding", "W = d - 1e-12", "balanced", Outcome::refused,
                           [](PackingSpec& s) { one_layer(s, 1 - 1e-12); }));
  scenes.push_back(packing("too narrow", "W = d / 2", "balanced", Outcome::refused,
                           [](PackingSpec& s) { one_layer(s, 0.5); }));
  scenes.push_back(packing("too narrow for the largest grain", "W = d, sizes spread by 1/30",
                           "balanced", Outcome::refused, [](PackingSpec& s) { s.box.width = 1; }));
}

void add_lengths(std::vector<Scene>& scenes) {
  scenes.push_back(packing("the shortest period", "L_x = 2.7 d, a margin above two grains",
                           "balanced", Outcome::right, [](PackingSpec& s) { s.box.length = 2.7; }));
  scenes.push_back(packing("both periods at their shortest", "L_x = W = 2.7 d", "balanced",
                           Outcome::right, [](PackingSpec& s) {
                             s.box = {2.7, 2.7, Boundary::periodic, Boundary::periodic};
                           }));
  scenes.push_back(packing("own images", "L_x = 2 d", "balanced", Outcome::refused,
                           [](PackingSpec& s) { s.box.length = 2; }));
  scenes.push_back(packing("a grain that is its own neighbour", "L_x = d", "balanced",
                           Outcome::refused, [](PackingSpec& s) { s.box.length = 1; }));
  scenes.push_back(packing("a long thin box", "L_x = 10,000 d, W = 1.2 d", "fast", Outcome::right,
                           [](PackingSpec& s) {
                             s.box = {10000, 1.2, Boundary::periodic, Boundary::walls};
                             s.fill = GrainCount{20000};
                           }));
  scenes.push_back(packing("a longer box", "L_x = 10,001 d", "fast", Outcome::refused,
                           [](PackingSpec& s) { s.box.length = 10001; }));
}

void add_heights(std::vector<Scene>& scenes) {
  for (const char* name : {"fast", "balanced"}) {
    scenes.push_back(packing("a tall bed", "70 d high", name, Outcome::right, [](PackingSpec& s) {
      s.box = {2.7, 2, Boundary::periodic, Boundary::walls};
      s.fill = GrainCount{380};
    }));
    scenes.push_back(
        packing("a very tall bed", "300 d high", name, Outcome::not_settled, [](PackingSpec& s) {
          s.box = {2.7, 2, Boundary::periodic, Boundary::walls};
          s.fill = GrainCount{1600};
        }));
    scenes.push_back(packing("a tall bed in a shaft", "walls all round, 2 d wide", name,
                             Outcome::right, [](PackingSpec& s) {
                               s.box = {2, 2, Boundary::walls, Boundary::walls};
                               s.fill = GrainCount{200};
                             }));
  }
}

void add_sizes(std::vector<Scene>& scenes) {
  for (const char* name : {"fast", "balanced", "accurate"}) {
    scenes.push_back(
        packing("a trace of small grains", "x_S = 1e-3", name, Outcome::right,
                [](PackingSpec& s) { s.sizes.small_share = 1e-3, s.fill = SolidHeight{4}; }));
    scenes.push_back(
        packing("a trace of large grains", "x_S = 0.999", name, Outcome::right,
                [](PackingSpec& s) { s.sizes.small_share = 0.999, s.fill = GrainCount{300}; }));
    scenes.push_back(
        packing("small grains only", "x_S = 1", name, Outcome::right,
                [](PackingSpec& s) { s.sizes.small_share = 1, s.fill = GrainCount{300}; }));
    scenes.push_back(packing("all sizes at once", "spread 0.2, cut at 0.2 and 1.8 d", name,
                             Outcome::right, [](PackingSpec& s) { s.sizes.spread = 0.2; }));
  }
  scenes.push_back(packing("the size ratio at its limit", "1 to 50", "balanced", Outcome::refused,
                           [](PackingSpec& s) {
                             s.sizes = {0, 0.1, 0.02};
                           }));
}

}  // namespace

std::vector<Scene> boxes() {
  std::vector<Scene> scenes;
  add_counts(scenes);
  add_widths(scenes);
  add_lengths(scenes);
  add_heights(scenes);
  add_sizes(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
