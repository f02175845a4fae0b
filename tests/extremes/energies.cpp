#include <algorithm>
#include <cstdio>

#include "engine/dynamics/step.hpp"
#include "engine/scene/start.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/judge.hpp"
#include "tests/extremes/packed.hpp"

namespace grainsweep::extremes {

namespace {

constexpr int steps_watched = 400;
constexpr double solved_to = 1e-9;  // m g

/// Mean energy of a grain, m g d: height and motion.
double energy_of(const SphereBed& bed, double dt) {
  double energy = 0.0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const Record<double>& u = bed.motion[i];
    const double squared = (u.x * u.x + u.y * u.y + u.z * u.z) / (2.0 * dt * dt);
    energy += (bed.position[i].z + squared) / u.w;
  }
  return energy / static_cast<double>(bed.grains());
}

/// Rows must reach as far as grains may approach each other in a step; what has no row may overlap,
/// and its repair adds energy. Up to a step of .2 the engine's own .08 d is enough here.
double near_of(double dt) { return dt <= 0.2 ? 0.08 : 2.0 * StepSettings{}.longest_free; }

/// Largest rise of the mean energy in one step of a fall that begins with no overlap. Nothing in a
/// step adds energy but what a solve leaves undone: overlaps of r dt^2 that are repaired.
Finding fall(double dt, double momentum) {
  SphereBed bed = *start<Sphere>(small_spec(80, {}));
  StepState<Sphere, double> state;
  StepSettings settings;
  settings.dt = dt;
  settings.momentum = momentum;
  settings.near = near_of(dt);
  settings.limits = {Solver::accelerated_gauss_seidel, 100'000, solved_to};
  double before = energy_of(bed, dt), rise = 0.0, worst_residual = 0.0;
  for (int k = 0; k < steps_watched; ++k) {
    worst_residual = std::max(worst_residual,
                              step(settings, kernels_for(best_isa()), bed, state).solve.residual);
    const double after = energy_of(bed, dt);
    rise = std::max(rise, after - before);
    before = after;
  }
  Finding finding;
  finding.finite = is_finite(bed);
  if (worst_residual > solved_to) finding.unrest = "a step is solved to more than 1e-9 m g";
  finding.answers = {{"rise of the mean energy in a step, m g d", rise, 10.0 * solved_to,
                      "ten contacts a grain at most, each solved to 1e-9 m g"}};
  return finding;
}

}  // namespace

std::vector<Scene> energies() {
  std::vector<Scene> scenes;
  for (const double momentum : {1.0, 0.9}) {
    for (const double dt : {0.01, 0.05, 0.1, 0.2, 0.4}) {
      char text[64];
      std::snprintf(text, sizeof text, "step %g, momentum %g", dt, momentum);
      scenes.push_back({"energy", "80 grains fall", text, "f64, 1e-9 m g", Outcome::right,
                        [=] { return fall(dt, momentum); }});
    }
  }
  return scenes;
}

}  // namespace grainsweep::extremes
