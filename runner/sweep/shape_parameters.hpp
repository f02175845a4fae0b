// The parameters that say what the grains are.
#pragma once

#include <string>
#include <vector>

#include "runner/sweep/parameters.hpp"

namespace grainsweep {

/// Their rows of the table of parameters. The shape's name comes before the parts that name a shape
/// too.
std::vector<Parameter> shape_parameters();

/// The shape, with its defaults, that the parameter `path` is a part of: "shape.prism.sides".
ShapeSpec shape_with_part(const std::string& path);

}  // namespace grainsweep
