#include "tests/extremes/accuracy_names.hpp"

#include "engine/dynamics/presets.hpp"

namespace grainsweep::extremes {

NamedAccuracy at_preset(const std::string& name) { return {name, preset(name).value()}; }

NamedAccuracy tight() {
  Accuracy a = preset("accurate").value();
  a.precision = Precision::f64;
  a.residual_tolerance = 1e-9;
  a.rest_iterations = 20'000;
  a.max_steps = 2000;
  a.overlap_tolerance = 1e-9;
  return {"`accurate`, f64, 1e-9 m g", a};
}

}  // namespace grainsweep::extremes
