#include "runner/sweep/draft.hpp"

#include "engine/dynamics/presets.hpp"

namespace grainsweep {

Draft::Draft() {
  if (const auto accuracy = grainsweep::preset(default_preset)) spec.accuracy = *accuracy;
}

}  // namespace grainsweep
