// The rows of the table of parameters.
#pragma once

#include <vector>

#include "runner/sweep/parameters.hpp"

namespace grainsweep {

/// All parameters, made anew; `parameters()` holds them.
std::vector<Parameter> parameter_rows();

}  // namespace grainsweep
