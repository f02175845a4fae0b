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
/// and that is noted at its place. What the engine refuses of shapes and shares is left to it.
/// Hulls keep their vertices as they are written, or none where they are in a file: `place_hull` is
/// to follow.
std::optional<Components> read_components(const Json& value, const std::string& pointer,
                                          Diagnostics& diagnostics);

/// Makes `points`, in which its size is d, the vertices of a component that is a hull.
void place_hull(std::vector<std::array<double, 3>> points, WrittenComponent& component);

}  // namespace grainsweep
