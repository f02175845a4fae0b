#include "engine/dynamics/presets.hpp"

#include <algorithm>

namespace grainsweep {

namespace {

// What each changes of `balanced`, which is a default Accuracy.

Accuracy fast() {
  Accuracy a;
  a.creep_steps = 240;
  a.rest_iterations = 40;
  a.residual_tolerance = 2e-2;
  a.kinetic_tolerance = 1e-3;
  a.contact_tolerance = 0.1;
  a.overlap_tolerance = 1e-4;
  a.imbalance_tolerance = 0.1;
  return a;
}

Accuracy accurate() {
  Accuracy a;
  a.path_tolerance = 1e-4;
  a.creep_steps = 960;
  a.residual_tolerance = 1e-3;
  a.kinetic_tolerance = 2e-5;
  a.contact_tolerance = 0.006;
  a.overlap_tolerance = 5e-6;
  a.imbalance_tolerance = 0.0033;
  a.imbalance_gap = 1e-5;
  return a;
}

/// Falls and creeps as `accurate`. Rest is found from what `balanced` calls settled.
Accuracy exact() {
  Accuracy a;
  a.path_tolerance = accurate().path_tolerance;
  a.creep_steps = accurate().creep_steps;
  a.rest = Rest::exact;
  return a;
}

/// Null if there is no preset of that name.
const Preset* find_preset(std::string_view name) {
  const auto found = std::find_if(presets().begin(), presets().end(),
                                  [&](const Preset& known) { return known.name == name; });
  return found != presets().end() ? &*found : nullptr;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"fast",
       "at least 90 % of the isostatic contacts, mean overlap below 1e-4 d",
       fast(),
       {ProtocolBias{0.0030, 0.056}, ProtocolBias{0.0023, 0.055}, ProtocolBias{0.0021, 0.097},
        ProtocolBias{0.0023, 0.037}, ProtocolBias{0.0025, 0.070}, ProtocolBias{0.0048, 0.134},
        ProtocolBias{0.0050, 0.105}}},
      {"balanced",
       "at least 98 % of the isostatic contacts, mean overlap below 1e-5 d",
       Accuracy{},
       {ProtocolBias{0.0020, 0.036}, ProtocolBias{0.0025, 0.053}, ProtocolBias{0.0012, 0.051},
        ProtocolBias{0.0028, 0.038}, ProtocolBias{0.0027, 0.047}, ProtocolBias{0.0030, 0.082},
        ProtocolBias{0.0039, 0.078}}},
      {"accurate",
       "at least 99.4 % of the isostatic contacts, mean overlap below 5e-6 d",
       accurate(),
       {ProtocolBias{0.0013, 0.014}, ProtocolBias{0.0031, 0.054}, ProtocolBias{0.0012, 0.022},
        ProtocolBias{0.0025, 0.032}, ProtocolBias{0.0023, 0.019}, ProtocolBias{0.0014, 0.034},
        ProtocolBias{0.0038, 0.066}}},
      {"exact",
       "spheres: forces balance to 1e-10 m g, with as many contacts as hold the bed",
       exact(),
       {ProtocolBias{0.0016, 0.010}, ProtocolBias{0.0026, 0.050}, ProtocolBias{0.0011, 0.014},
        ProtocolBias{0.0025, 0.024}, ProtocolBias{0.0023, 0.021}, std::nullopt, std::nullopt}}};
  return all;
}

std::optional<Accuracy> preset(std::string_view name) {
  const Preset* known = find_preset(name);
  return known != nullptr ? std::optional(known->accuracy) : std::nullopt;
}

std::optional<ProtocolBias> bias_bound(std::string_view preset_name, BedKind kind) {
  const Preset* known = find_preset(preset_name);
  return known != nullptr ? known->bias_bounds.at(static_cast<std::size_t>(kind)) : std::nullopt;
}

std::string_view settles_as(const Accuracy& accuracy) {
  for (const Preset& known : presets()) {
    Accuracy same = known.accuracy;
    same.precision = accuracy.precision;
    same.max_steps = accuracy.max_steps;
    if (same == accuracy) return known.name;
  }
  return "";
}

}  // namespace grainsweep
