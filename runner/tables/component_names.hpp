// What the components of a mixture are called: by their shapes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runner/tables/job_facts.hpp"

namespace grainsweep {

/// "sphere", "cylinder (height 2)": the shapes of a mixture's components, in the order of their
/// numbers. Where several have one shape, it is followed by the parts in which they differ, or, if
/// these do not tell them apart, by their number: "sphere (3)". Empty if the grains are no mixture.
std::vector<std::string> component_names(const JobFacts& job);

/// What the columns of a component and of another one with these names say.
inline constexpr const char* component_shape_meaning =
    "its shape, with what tells it from others of the same";
inline constexpr const char* other_shape_meaning = "the shape of that one, likewise";

/// The number of the component whose share in a mixture is this parameter, from 1; 0 for others.
std::size_t component_of_share(std::string_view path);

}  // namespace grainsweep
