// What lengths of a shape must be.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "engine/interval.hpp"
#include "engine/text.hpp"

namespace grainsweep {

/// In d: no container is longer, and far from both ends products of lengths remain numbers.
inline constexpr Interval lengths_of_shapes{1e-6, 10'000.0};

/// What is wrong with a length; "" if nothing is.
inline std::string problem_with_length(const char* name, double value) {
  if (lengths_of_shapes.holds(value)) return "";
  return joined(name, " must lie in ", lengths_of_shapes.text(), ", is ", value);
}

/// The same for the first length that is wrong.
inline std::string problem_with_lengths(
    std::initializer_list<std::pair<const char*, double>> lengths) {
  for (const auto& [name, value] : lengths) {
    std::string problem = problem_with_length(name, value);
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace grainsweep
