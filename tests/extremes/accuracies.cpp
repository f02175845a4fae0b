
#include "engine/dynamics/presets.hpp"
#include "engine/text.hpp"
#include "tests/extremes/accuracy_names.hpp"
#include "tests/extremes/catalogue.hpp"
#include "tests/extremes/packed.hpp"

namespace grainsweep::extremes {

namespace {

std::string name_of(Precision precision) { return precision == Precision::f32 ? "f32" : "f64"; }

/// A bed of 100 grains settled at `balanced` with parts of it changed.
template <class Change>
Scene changed(const std::string& extreme, Precision precision, Outcome expected, Change change) {
  Accuracy accuracy = preset("balanced").value();
  accuracy.precision = precision;
  accuracy.max_steps = 1500;
  change(accuracy);
  return {"accuracies", "a bed of 100",
          extreme,      "balanced, " + name_of(precision),
          expected,     [=] { return pack(small_spec(100, accuracy)); }};
}

Outcome right_if(bool expected) { return expected ? Outcome::right : Outcome::not_settled; }

void add_steps(std::vector<Scene>& scenes) {
  for (const double step : {1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.3, 0.4, 0.5, 0.8, 1.0, 1.5, 2.0}) {
    // Short steps do not come to rest in as many as are allowed, long ones overlap or keep moving.
    const Outcome expected = right_if(step >= 0.1 && step <= 0.4);
    scenes.push_back(changed("step " + number_text(step, 6), Precision::f64, expected,
                             [=](Accuracy& a) { a.step = step; }));
    scenes.push_back(changed("step " + number_text(step, 6) + ", plain dynamics", Precision::f32,
                             expected, [=](Accuracy& a) {
                               a.step = step;
                               a.protocol = Protocol::dynamic;
                               a.max_steps = 3000;
                             }));
  }
}

void add_tolerances(std::vector<Scene>& scenes) {
  for (int power = 1; power <= 12; ++power) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      const std::string text = "1e-" + std::to_string(power);
      const double tolerance = std::stod(text);
      // At .1 grains overlap too much; f32 rounds at 1e-5 to 1e-4. At 1e-10 f64 ends with a contact
      // or two too few in this bed.
      const bool is_right = power > 1 && (precision == Precision::f64 ? power != 10 : power <= 5);
      scenes.push_back(
          changed("residual tolerance " + text, precision, right_if(is_right), [=](Accuracy& a) {
            a.residual_tolerance = tolerance;
            a.max_steps = 1500;
          }));
    }
  }
}

void add_iterations(std::vector<Scene>& scenes) {
  for (const int iterations : {1, 3, 10, 100, 1000, 10'000, 100'000}) {
    for (const Precision precision : {Precision::f32, Precision::f64}) {
      // With one iteration overlaps stay a little above what is allowed.
      const bool is_right = iterations > 3 || (iterations == 3 && precision == Precision::f64);
      scenes.push_back(changed(std::to_string(iterations) + " iterations a step", precision,
                               right_if(is_right), [=](Accuracy& a) {
                                 a.fall_iterations = a.rest_iterations = iterations;
                                 a.max_steps = 20000;  // of 48 beds at 3, rest after 315 to 5670
                               }));
    }
  }
}

void add_sweeps_without_momentum(std::vector<Scene>& scenes) {
  for (const double step : {0.01, 0.2, 0.4}) {
    scenes.push_back(changed("pgs, step " + number_text(step, 6), Precision::f32,
                             right_if(step >= 0.1), [=](Accuracy& a) {
                               a.solver = Solver::projected_gauss_seidel;
                               a.step = step;
                             }));
  }
}

void add_limits(std::vector<Scene>& scenes) {
  const Precision f32 = Precision::f32;
  const Outcome right = Outcome::right;
  scenes.push_back(changed("momentum 0", f32, right, [](Accuracy& a) { a.momentum = 0.0; }));
  scenes.push_back(changed("momentum 0.999", f32, right, [](Accuracy& a) { a.momentum = 0.999; }));
  scenes.push_back(changed("no creep", f32, right, [](Accuracy& a) { a.creep_steps = 0; }));
  scenes.push_back(
      changed("one step", f32, Outcome::not_settled, [](Accuracy& a) { a.max_steps = 1; }));
  scenes.push_back(changed("every tolerance 1e-12", Precision::f64, right, [](Accuracy& a) {
    a.residual_tolerance = a.kinetic_tolerance = a.overlap_tolerance = a.contact_tolerance = 1e-12;
    a.max_steps = 20000;
  }));
}

}  // namespace

std::vector<Scene> accuracies() {
  std::vector<Scene> scenes;
  add_steps(scenes);
  add_tolerances(scenes);
  add_iterations(scenes);
  add_sweeps_without_momentum(scenes);
  add_limits(scenes);
  return scenes;
}

}  // namespace grainsweep::extremes
