// The components of a mixture, as a sweep writes them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/resolved_spec.hpp"

namespace grainsweep {

/// Reads `[{"share": 0.7, "cube": {}}, ...]`, written at `pointer`; nothing if anything is wrong,
/// which is then noted at its place. What the engine refuses about shapes and shares is left to it.
/// Hulls keep their vertices as they are written, or none where they are in a file: `place_hull`
/// must follow.
std::optional<Components> read_components(const Json& value, const std::string& pointer,
                                          Diagnostics& diagnostics);

/// Makes `points`, in units of d, the vertices of a component that is a hull.
void place_hull(std::vector<std::array<double, 3>> points, WrittenComponent& component);

}  // namespace grainsweep
