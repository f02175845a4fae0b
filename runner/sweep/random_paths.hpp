// Reading the "random" part of a block.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"
#include "runner/sweep/random_points.hpp"

namespace grainsweep {

/// Most points that a block may draw.
inline constexpr std::uint64_t most_random_points = 1'000'000;

/// The paths of `random`, an object written at `pointer`; those with a problem are left out.
std::vector<RandomPath> read_random_paths(const Json& random, const std::string& pointer,
                                          Diagnostics& diagnostics);

/// Its "count": the number of points to draw; 0 if there is none.
std::uint64_t read_random_count(const Json& random, const std::string& pointer,
                                Diagnostics& diagnostics);

}  // namespace grainsweep
