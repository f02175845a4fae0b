#include <array>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/exact/halves.hpp"

namespace grainsweep {
namespace {

using Places = std::vector<std::array<double, 3>>;

TEST_CASE("items are halved across their longest extent, equal ones by their numbers") {
  const Places places = {{0, 4, 1}, {1, 2, 0}, {0, 9, 1}, {1, 2, 1}, {0, 0, 0}};
  const auto coordinate = [&](std::int32_t item, int axis) {
    return places[static_cast<std::size_t>(item)][static_cast<std::size_t>(axis)];
  };
  std::vector<std::int32_t> items = {3, 2, 1, 0, 4};
  CHECK(longest_axis(items.begin(), items.end(), coordinate) == 1);
  const auto middle = halve(items.begin(), items.end(), coordinate);
  CHECK(items == std::vector<std::int32_t>{4, 1, 3, 0, 2});
  CHECK(middle - items.begin() == 2);
}

TEST_CASE("items are halved along an axis that is asked for") {
  const std::vector<double> heights = {3, 1, 2, 0};
  std::vector<std::int32_t> items = {0, 1, 2, 3};
  const auto middle = halve_along(2, items.begin(), items.end(), [&](std::int32_t item, int axis) {
    return axis == 2 ? heights[static_cast<std::size_t>(item)] : 10.0 * item;
  });
  CHECK(items == std::vector<std::int32_t>{3, 1, 2, 0});
  CHECK(middle - items.begin() == 2);
}

TEST_CASE("a single item is in the second half") {
  std::vector<std::int32_t> items = {7};
  const auto middle = halve(items.begin(), items.end(), [](std::int32_t, int) { return 0.5; });
  CHECK(middle == items.begin());
}

}  // namespace
}  // namespace grainsweep
