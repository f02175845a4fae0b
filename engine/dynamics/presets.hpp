// Named values of `Accuracy`, and what each promises.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/scene/spec.hpp"

namespace grainsweep {

struct Preset {
  std::string_view name;
  std::string_view promise;  ///< one sentence with numbers, for --help and the README
  Accuracy accuracy;
};

/// fast, balanced, accurate.
const std::vector<Preset>& presets();

/// The preset called `name`, if there is one.
std::optional<Accuracy> preset(std::string_view name);

}  // namespace grainsweep
