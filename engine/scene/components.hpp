// Which grain of a bed is of which component of a mixture.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

/// Of each of `grains`, in the order in which their sizes are drawn (engine/scene/sizes.hpp), the
/// number of its component, from 0; empty if the shape is no mixture. The number of grains of each
/// is exact (engine/shape/mixture.hpp), who they are is drawn whatever their sizes. Same key, same
/// components.
std::vector<std::uint8_t> draw_components(const ShapeSpec& shape, std::size_t grains,
                                          std::uint64_t key);

}  // namespace grainsweep
