// Accuracies that scenes are run at, by the names they have in the table.
#pragma once

#include <string>

#include "engine/scene/spec.hpp"

namespace grainsweep::extremes {

struct NamedAccuracy {
  std::string name;
  Accuracy accuracy;
};

/// One of the presets. Requires a name of engine/dynamics/presets.hpp.
NamedAccuracy at_preset(const std::string& name);

/// `accurate` in f64, rows solved to 1e-9 m g with as many iterations as it takes.
NamedAccuracy tight();

}  // namespace grainsweep::extremes
