#include "runner/sweep/resolved_spec.hpp"

#include "engine/dynamics/presets.hpp"

namespace grainsweep {

ResolvedSpec::ResolvedSpec() {
  if (const auto accuracy = grainsweep::preset(default_preset)) spec.accuracy = *accuracy;
}

}  // namespace grainsweep
