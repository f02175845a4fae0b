// What lengths of a shape must be.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "engine/text.hpp"

namespace grainsweep {

/// What is wrong with a length; "" if it is a positive finite number.
inline std::string problem_with_length(const char* name, double value) {
  if (std::isfinite(value) && value > 0.0) return "";
  return joined(name, " must be a positive finite number, is ", value);
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
