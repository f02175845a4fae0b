#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/rows/pair_memories.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

/// Of `grains` grains each two by chance, in random order.
std::vector<GrainPair> drawn_pairs(Draw& draw, std::int32_t grains, double share) {
  std::vector<GrainPair> pairs;
  for (std::int32_t a = 0; a < grains; ++a) {
    for (std::int32_t b = a + 1; b < grains; ++b) {
      if (draw.chance(share)) pairs.push_back({a, b});
    }
  }
  draw.shuffle(pairs);
  return pairs;
}

Vector mark_of(const GrainPair& pair) { return {double(pair.a), double(pair.b), 1.0}; }

TEST_CASE("pairs that were listed before remember what they did, others nothing") {
  Draw draw(3);
  for (const std::int32_t grains : {0, 1, 2, 40, 200}) {
    PairMemoryColumns columns;
    const std::vector<GrainPair> pairs = drawn_pairs(draw, grains, 0.4);
    columns.pairs = drawn_pairs(draw, grains, 0.4);
    std::vector<PairMemory> memory(columns.pairs.size());
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k].axis = mark_of(columns.pairs[k]);
    keep_memories(static_cast<std::size_t>(grains), pairs, serial_for, memory, columns);
    REQUIRE(memory.size() == pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      bool was_listed = false;
      for (const GrainPair& pair : columns.pairs) {
        was_listed = was_listed || (pair.a == pairs[k].a && pair.b == pairs[k].b);
      }
      CHECK(memory[k].axis == (was_listed ? mark_of(pairs[k]) : Vector(Vector::Zero())));
    }
  }
}

}  // namespace
}  // namespace grainsweep
