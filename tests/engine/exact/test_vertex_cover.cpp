#include <algorithm>

#include <catch2/catch.hpp>

#include "engine/exact/vertex_cover.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

std::size_t count(const VertexCover& cover) {
  return static_cast<std::size_t>(std::count(cover.left.begin(), cover.left.end(), 1) +
                                  std::count(cover.right.begin(), cover.right.end(), 1));
}

/// Fewest vertices by trying every choice of left ones: all partners of the others are taken.
std::size_t fewest(const Partners& partners, std::size_t right) {
  std::size_t least = partners.size();
  for (std::size_t choice = 0; choice < std::size_t{1} << partners.size(); ++choice) {
    std::vector<bool> taken(right, false);
    std::size_t size = 0;
    for (std::size_t k = 0; k < partners.size(); ++k) {
      if ((choice >> k & 1) != 0) {
        ++size;
      } else {
        for (const std::int32_t partner : partners[k]) {
          taken[static_cast<std::size_t>(partner)] = true;
        }
      }
    }
    size += static_cast<std::size_t>(std::count(taken.begin(), taken.end(), true));
    least = std::min(least, size);
  }
  return least;
}

TEST_CASE("a cover has an end of each edge, and none has fewer vertices") {
  testing::Draw draw(4);
  for (int k = 0; k < 300; ++k) {
    const std::size_t left = draw.below(9), right = draw.below(9);
    Partners partners(left);
    for (auto& own : partners) {
      for (std::size_t vertex = 0; vertex < right; ++vertex) {
        if (draw.chance(0.3)) own.push_back(static_cast<std::int32_t>(vertex));
      }
    }
    const VertexCover cover = smallest_cover(partners, right);
    REQUIRE((cover.left.size() == left && cover.right.size() == right));
    for (std::size_t vertex = 0; vertex < left; ++vertex) {
      for (const std::int32_t partner : partners[vertex]) {
        CHECK((cover.left[vertex] != 0 || cover.right[static_cast<std::size_t>(partner)] != 0));
      }
    }
    CHECK(count(cover) == fewest(partners, right));
  }
}

TEST_CASE("a star is covered by its middle, a path by every second vertex") {
  const VertexCover star = smallest_cover({{0}, {0}, {0}, {0}}, 1);
  CHECK(star.left == std::vector<std::uint8_t>{0, 0, 0, 0});
  CHECK(star.right == std::vector<std::uint8_t>{1});
  CHECK(count(smallest_cover({{0}, {0, 1}, {1, 2}, {2, 3}}, 4)) == 4);
  CHECK(count(smallest_cover({{0}, {0, 1}, {1}}, 2)) == 2);
}

}  // namespace
}  // namespace grainsweep
