// Which shape an assignment names: all shapes are one choice, and so are the two ways to give the
// vertices of a hull.
#pragma once

#include <string_view>

#include "runner/sweep/assignments.hpp"

namespace grainsweep {

/// Name of a shape: "sphere", "pinacoid", "hull"; of a hull also where its vertices come from,
/// "hull.vertices" or "hull.file". "" where the assignment is about something else. It lives as
/// long as parameters().
std::string_view shape_named_by(const Assignment& assignment);

/// Whether grains cannot be both.
bool exclude_each_other(std::string_view a, std::string_view b);

/// The name that says more: of a hull, where its vertices come from.
std::string_view more_exact(std::string_view a, std::string_view b);

}  // namespace grainsweep
