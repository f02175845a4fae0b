#include <algorithm>
#include <cmath>

#include "tests/extremes/catalogue.hpp"
#include "tests/support/shape_beds.hpp"

namespace grainsweep::extremes {

namespace {

constexpr double residual = 1e-9;  // m g
constexpr int steps_taken = 5;

StepSettings settings_of_stack() {
  StepSettings settings;
  settings.momentum = 0.0;
  settings.correction = 1.0;
  settings.limits = {Solver::accelerated_gauss_seidel, 200'000, residual};
  return settings;
}

/// Grains exactly above each other, faces flat on faces.
PolyhedronBed stack_of(const ConvexShape& shape, int grains) {
  double half = 0.0;
  for (const Vector& v : shape.vertices) half = std::max(half, v.z());
  std::vector<Pose> poses;
  for (int k = 0; k < grains; ++k) poses.push_back(testing::pose_at(3, 3, (2 * k + 1) * half));
  return testing::shape_bed({6, 6, Boundary::periodic, Boundary::walls}, shape, poses);
}

/// Force that a contact carries: that of the grains above, between neighbours and on the floor.
/// Thin grains have rows with others near them, too, that must not push.
double exact_force(const PolyhedronBed& bed, const PolyhedronContact& c) {
  const auto grains = static_cast<double>(bed.grains());
  if (bed.is_grain(c.b)) return c.b == c.a + 1 ? grains - c.b : 0.0;
  return c.a == 0 ? grains : 0.0;
}

/// Largest error of the force of a contact, in the weight of all.
double force_error(const PolyhedronBed& bed, const StepState<Polyhedron, double>& state,
                   double dt) {
  double worst = 0.0;
  for (std::size_t k = 0; k < testing::list_of(state).contacts.size(); ++k) {
    const double exact = exact_force(bed, testing::list_of(state).contacts[k]);
    worst = std::max(worst, std::abs(testing::contact_force(state, k, dt) - exact));
  }
  return worst / static_cast<double>(bed.grains());
}

double place_error(const PolyhedronBed& before, const PolyhedronBed& after) {
  double worst = 0.0;
  for (std::size_t i = 0; i < before.grains(); ++i) {
    const Record<double>&p = before.position[i], &q = after.position[i];
    worst = std::max(worst, std::hypot(p.x - q.x, p.y - q.y, p.z - q.z));
  }
  return worst;
}

Finding stand(const ConvexShape& shape, int grains) {
  const PolyhedronBed begin = stack_of(shape, grains);
  PolyhedronBed bed = begin;
  StepState<Polyhedron, double> state;
  const StepSettings settings = settings_of_stack();
  StepReport report;
  for (int k = 0; k < steps_taken; ++k)
    report = step(settings, kernels_for(best_isa()), bed, state);
  const auto number = static_cast<double>(grains);
  Finding finding;
  if (report.solve.residual > residual)
    finding.unrest = "the last step is solved to more than 1e-9 m g";
  finding.answers = {
      {"force under any grain over the weight", force_error(bed, state, settings.dt),
       4.0 * 2.0 * number * residual, "four rows a face, each with a residual, added up"},
      {"motion of any grain, d", place_error(begin, bed),
       steps_taken * 4.0 * 2.0 * number * residual * settings.dt * settings.dt + 1e-12 * number,
       "residuals added up, and roundings of heights"}};
  for (const Record<double>& c : bed.centres())
    finding.finite = finding.finite && std::isfinite(c.x + c.y + c.z);
  return finding;
}

Scene stack(const std::string& name, const std::string& extreme, const ConvexShape& shape,
            int grains) {
  return {"stacks",        name,           extreme,
          "f64, 1e-9 m g", Outcome::right, [=] { return stand(shape, grains); }};
}

}  // namespace

std::vector<Scene> stacks() {
  return {stack("stack of 50 cubes", "49 cubes on one", testing::cube(), 50),
          stack("stack of 50 plates", "1 to 10", testing::box_shape(1, 1, 0.1), 50),
          stack("stack of 50 thin plates", "1 to 100", testing::box_shape(1, 1, 0.01), 50),
          stack("stack of 50 planks", "1 to 10 to 100", testing::box_shape(1, 0.1, 0.01), 50),
          stack("stack of 2 thin plates", "1 to 1000", testing::box_shape(1, 1, 0.001), 2)};
}

}  // namespace grainsweep::extremes
