// Evenly spaced values of a grid: {"from": 1.05, "to": 10, "count": 400}.
#pragma once

#include <string>

#include "runner/sweep/diagnostic.hpp"
#include "runner/sweep/json_text.hpp"

namespace grainsweep {

inline constexpr std::int64_t most_spaced_values = 1'000'000;

/// The list of values that such an object stands for, both ends included, each rounded to nine
/// digits, or to the nearest whole number if they are whole; notes what is wrong with it and
/// returns null.
Json spaced_values(const std::string& path, const Json& range, const std::string& pointer,
                   Diagnostics& diagnostics);

}  // namespace grainsweep
