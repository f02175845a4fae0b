#include <algorithm>
#include <cmath>

#include "engine/dynamics/balance.hpp"
#include "engine/dynamics/presets.hpp"
#include "engine/dynamics/workspace.hpp"
#include "engine/measure/coordination.hpp"
#include "engine/measure/solid_fraction.hpp"
#include "engine/scene/start.hpp"
#include "engine/units.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/packed.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep::extremes {

namespace {

const Kernels& kernels() { return kernels_for(best_isa()); }

/// Hexagonal layers of a hexagonal close packing: nx by 2 ny spheres, nz layers.
SphereBed hcp_bed(int nx, int ny, int nz) {
  const double row = std::sqrt(3.0) / 2.0, rise = std::sqrt(2.0 / 3.0);
  std::vector<PlacedSphere> spheres;
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < 2 * ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const double across = k % 2 == 0 ? 0.0 : row / 3.0;
        const double along = (j % 2 + k % 2) % 2 == 0 ? 0.0 : 0.5;
        spheres.push_back({i + along, j * row + across, 0.5 + k * rise, 0.5});
      }
    }
  }
  return make_bed({static_cast<double>(nx), 2 * ny * row, Boundary::periodic, Boundary::periodic},
                  spheres);
}

/// Solid fraction and coordination of a dense crystal, measured over whole layers `rise` apart.
Finding measure_crystal(SphereBed bed, double rise, int layers) {
  const Slab slab{0.5 + 2 * rise, 0.5 + (2 + layers) * rise};
  const double dense = pi / std::sqrt(18.0);
  const Touching touching = find_touching(bed, 1e-6, kernels());
  // A slab from mid-layer to mid-layer holds half of each of its two outer layers, so that whole
  // layers' worth of volume lie in it; of the two, the lower counts as inside.
  const double z = coordination(bed, touching, slab, 1e-6).with_walls;
  Finding finding;
  finding.answers = {{"solid fraction", std::abs(solid_fraction(bed, slab) - dense), 1e-12,
                      "roundings of some thousand volumes"},
                     {"coordination number", std::abs(z - 12.0), 0.0,
                      "an integer, gaps are 1e-15 d or above .4 d"}};
  return finding;
}

/// A sphere cut by a slab of any position: its volume by summing thin discs.
Finding sphere_in_slab(double radius, double low, double high) {
  const double a = std::clamp(low, -radius, radius), b = std::clamp(high, -radius, radius);
  constexpr int discs = 200'000;
  long double volume = 0.0L;
  for (int k = 0; k < discs; ++k) {
    const long double z = a + (b - a) * (static_cast<long double>(k) + 0.5L) / discs;
    volume += (static_cast<long double>(radius) * radius - z * z) * (b - a) / discs;
  }
  const double exact = static_cast<double>(volume * 3.14159265358979323846L);
  const double whole = sphere_volume(radius);
  Finding finding;
  finding.answers = {{"volume over that of the sphere",
                      std::abs(sphere_slab_volume(radius, low, high) - exact) / whole, 1e-10,
                      "discs by the middle rule are true to 1 / (12 n^2)"}};
  return finding;
}

/// Two spheres against the walls of a gap and one on both: known forces, solved step by step.
/// Centres of the lower ones are `half` to each side of the upper one.
Finding wedge_of_three(double half) {
  const double width = 2.0 * half + 1.0, rise = std::sqrt(1.0 - half * half);
  SphereBed bed = make_bed(
      {1, width, Boundary::walls, Boundary::walls},
      {{0.5, 0.5, 0.5, 0.5}, {0.5, width - 0.5, 0.5, 0.5}, {0.5, width / 2, 0.5 + rise, 0.5}});
  StepSettings settings;
  settings.momentum = 0.0;
  settings.correction = 1.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 1'000'000, 1e-10};
  StepState<Sphere, double> state;
  StepReport report;
  for (int k = 0; k < 10; ++k) report = step(settings, kernels(), bed, state);
  const auto impulses = testing::impulses_of(bed, state.contacts);
  const auto force = [&](std::int32_t a, std::int32_t b) {
    const auto found = impulses.find({a, b});
    return found == impulses.end() ? 0.0 : found->second / (settings.dt * settings.dt);
  };
  const double side = 0.5 / rise, wall = half * side;
  const double worst = std::max({std::abs(force(0, 2) - side), std::abs(force(1, 2) - side),
                                 std::abs(force(0, testing::wall_name(bed, 3)) - wall),
                                 std::abs(force(1, testing::wall_name(bed, 4)) - wall),
                                 std::abs(force(0, testing::wall_name(bed, 0)) - 1.5),
                                 std::abs(force(1, testing::wall_name(bed, 0)) - 1.5)});
  Finding finding;
  finding.finite = is_finite(bed);
  if (report.solve.residual > 1e-10)
    finding.unrest = "the last step is solved to more than 1e-10 m g";
  // The upper sphere drops by a gap over rise: a wedge's forces change by gap / rise^3.
  finding.answers = {{"any force, m g", worst, 20.0 * 1e-10 / (rise * rise * rise) / 1e-1,
                      "a residual of 1e-10 m g in each of six rows, levered by the wedge"}};
  return finding;
}

/// A bed settled at an accuracy, and whether its closed contacts can carry it.
Finding balance(std::int64_t grains, double width, const Accuracy& accuracy) {
  PackingSpec spec = small_spec(grains, accuracy);
  spec.box.length = 20;
  spec.box.width = width;
  SphereBed bed = *start<Sphere>(spec);
  const SettleReport report =
      settle(accuracy, kernels(), bed, [](const Progress&) { return true; });
  Finding finding;
  finding.finite = is_finite(bed);
  finding.unrest = report.failure;
  const double bound = std::sqrt(2.0 * accuracy.kinetic_tolerance) / last_step(accuracy);
  finding.answers = {{"mean unbalanced force of a grain, in its weight", report.rest.imbalance.mean,
                      bound,
                      "the best forces leave no more than those found, which move grains no faster "
                      "than the kinetic tolerance"}};
  return finding;
}

void add_crystals(std::vector<Scene>& scenes) {
  for (const int side : {3, 8}) {
    const std::string cells = std::to_string(side) + " cells wide, every grain touches 12";
    scenes.push_back({"exact", "fcc crystal", cells, "measures", Outcome::right, [=] {
                        return measure_crystal(testing::fcc_bed(side, side, 8), std::sqrt(0.5), 8);
                      }});
    scenes.push_back({"exact", "hcp crystal", cells, "measures", Outcome::right, [=] {
                        return measure_crystal(hcp_bed(side, side, 14), std::sqrt(2.0 / 3.0), 8);
                      }});
  }
}

void add_slabs(std::vector<Scene>& scenes) {
  struct Cut {
    const char* name;
    double low, high;
  };
  for (const Cut& cut : {Cut{"above it all", 0.6, 2},
                         {"around it", -2, 2},
                         {"a cap of 1e-6 d", 0.5 - 1e-6, 1},
                         {"a slice of 1e-9 d", 0.1, 0.1 + 1e-9},
                         {"the lower half", -1, 0}}) {
    scenes.push_back({"exact", "sphere in a slab", cut.name, "measures", Outcome::right,
                      [cut] { return sphere_in_slab(0.5, cut.low, cut.high); }});
  }
}

void add_wedges(std::vector<Scene>& scenes) {
  for (const double half : {0.51, 0.6, 0.8, 0.95, 0.99, 0.999}) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f degrees from level", std::acos(half) * 180.0 / pi);
    scenes.push_back({"exact", "wedge of three", text, "f64, 1e-10 m g", Outcome::right,
                      [half] { return wedge_of_three(half); }});
  }
}

void add_balances(std::vector<Scene>& scenes) {
  for (const char* name : {"fast", "balanced", "accurate"}) {
    const NamedAccuracy at = at_preset(name);
    scenes.push_back({"exact", "2000 grains", "forces again by a direct solve", at.name,
                      Outcome::right, [at] { return balance(2000, 5, at.accuracy); }});
  }
}

}  // namespace

std::vector<Scene> exact_answers() {
  std::vector<Scene> scenes;
  add_crystals(scenes);
  add_slabs(scenes);
  add_wedges(scenes);
  add_balances(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
