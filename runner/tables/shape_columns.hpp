// The columns of the tables that only grains have that are no spheres.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/results.hpp"

namespace grainsweep {

/// Contacts that are simple, double and triple as shares of all, the shares of the force that they
/// carry, and the nematic order of the axes of the shape: names of columns, and their values.
inline constexpr std::array<const char*, 9> shape_columns = {
    "contacts_simple", "contacts_double", "contacts_triple", "force_simple", "force_double",
    "force_triple",    "nematic_x",       "nematic_y",       "nematic_z"};
std::array<double, shape_columns.size()> shape_values(const ShapeOrder& order);

/// The names, each followed by its own with "_sd" if they are means of replicates.
std::vector<std::string> shape_header(bool with_sd);

}  // namespace grainsweep
