// The components of a mixture, as a sweep writes them.
#pragma once

#include <optional>
#include <string>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// Reads `[{"share": 0.7, "cube": {}}, ...]`, written at `pointer`; nothing if anything is wrong,
/// and that is noted at its place. What the engine refuses of shapes and shares is left to it.
std::optional<Components> read_components(const Json& value, const std::string& pointer,
                                          Diagnostics& diagnostics);

}  // namespace grainsweep
