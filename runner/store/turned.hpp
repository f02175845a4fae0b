// How grains that are no spheres are turned, and their mesh, as bytes of a stored bed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/results.hpp"

namespace grainsweep {

/// Appends, little-endian, f64 x, y, z, w of each orientation; u32 number of vertices and f64 x, y,
/// z of each; u32 number of faces and of each u32 number of corners and u32 vertices.
void put_turned(std::string& bytes, const Turned& turned);

/// Takes what put_turned appended for `grains` grains off the front. Throws std::length_error if it
/// ends too early, std::out_of_range if a face names no vertex.
Turned take_turned(std::string_view& bytes, std::size_t grains);

}  // namespace grainsweep
