// Which component of a mixture each grain of a bed belongs to.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/shape/shape_spec.hpp"

namespace grainsweep {

/// The number of the component, from 0, of each of `grains` grains, in the order in which their
/// sizes are drawn (engine/scene/sizes.hpp); empty if the shape is not a mixture. The number of
/// grains of each component is exact (engine/shape/mixture.hpp); which grains they are is drawn
/// regardless of size. Same key, same components.
std::vector<std::uint8_t> draw_components(const ShapeSpec& shape, std::size_t grains,
                                          std::uint64_t key);

}  // namespace grainsweep
