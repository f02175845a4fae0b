#include <vector>

#include <catch2/catch.hpp>

#include "engine/rows/pair_memories.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

/// Of `grains` grains each two by chance.
std::vector<GrainPair> drawn_pairs(Draw& draw, std::int32_t grains, double share) {
  std::vector<GrainPair> pairs;
  for (std::int32_t a = 0; a < grains; ++a) {
    for (std::int32_t b = a + 1; b < grains; ++b) {
      if (draw.chance(share)) pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Two thirds of them, in random order.
std::vector<GrainPair> most_of(std::vector<GrainPair> pairs, Draw& draw) {
  draw.shuffle(pairs);
  pairs.resize(2 * pairs.size() / 3);
  return pairs;
}

constexpr GrainPair nothing{-1, -1};

TEST_CASE("pairs that were listed before remember what they did, others nothing") {
  Draw draw(3);
  for (const std::int32_t grains : {0, 1, 2, 40, 200, 4200}) {  // the last in two parts
    const std::vector<GrainPair> all = drawn_pairs(draw, grains, 12.0 / (12.0 + grains));
    const std::vector<GrainPair> pairs = most_of(all, draw);
    PairMemoryColumns columns;
    columns.pairs = most_of(all, draw);
    std::vector<GrainPair> memory = columns.pairs, spare;
    match_pairs(static_cast<std::size_t>(grains), pairs, serial_for, columns);
    keep_memories(columns, serial_for, nothing, memory, spare);
    REQUIRE(memory.size() == pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      bool was_listed = false;
      for (const GrainPair& pair : columns.pairs) {
        was_listed = was_listed || (pair.a == pairs[k].a && pair.b == pairs[k].b);
      }
      CHECK(memory[k].a == (was_listed ? pairs[k].a : nothing.a));
      CHECK(memory[k].b == (was_listed ? pairs[k].b : nothing.b));
    }
  }
}

}  // namespace
}  // namespace grainsweep
