// Halves of items that have a place each, as nested dissections take them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace grainsweep {

/// The axis along which the items extend furthest, the first of several. `coordinate(item, axis)`
/// is that of an item along axis 0, 1 or 2.
template <class At, class Coordinate>
int longest_axis(At first, At last, const Coordinate& coordinate) {
  std::array<double, 3> extent{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(first, last, [&](std::int32_t p, std::int32_t q) {
      return coordinate(p, axis) < coordinate(q, axis);
    });
    extent[static_cast<std::size_t>(axis)] = coordinate(*high, axis) - coordinate(*low, axis);
  }
  return static_cast<int>(std::max_element(extent.begin(), extent.end()) - extent.begin());
}

/// Sorts items by their coordinate along an axis, those with the same by their number. Returns
/// where the second half begins, which has one more of an odd number.
template <class At, class Coordinate>
At halve_along(int axis, At first, At last, const Coordinate& coordinate) {
  std::sort(first, last, [&](std::int32_t p, std::int32_t q) {
    return std::pair(coordinate(p, axis), p) < std::pair(coordinate(q, axis), q);
  });
  return first + (last - first) / 2;
}

/// Halves items, at least one, along their longest extent.
template <class At, class Coordinate>
At halve(At first, At last, const Coordinate& coordinate) {
  return halve_along(longest_axis(first, last, coordinate), first, last, coordinate);
}

}  // namespace grainsweep
