// The grains that rows of the kernels' tests name.
#pragma once

#include <cstdint>

namespace grainsweep {

inline constexpr std::int32_t row_grains = 150, wall = row_grains, void_a = row_grains + 1,
                              void_b = row_grains + 2;

}  // namespace grainsweep
