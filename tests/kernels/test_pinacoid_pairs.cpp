#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "kernels/kernels.hpp"
#include "tests/support/bits.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/pinacoid_twin.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

struct Grains {
  std::vector<Record<double>> centres, orientations;
  std::vector<PinacoidBlock> blocks;
};

/// `blocks` blocks of pairs among 100 grains, close to one another across the borders of a box
/// of 3.
Grains random_grains(std::size_t blocks, std::uint64_t seed) {
  Draw draw(seed);
  Grains grains;
  for (int k = 0; k < 100; ++k) {
    grains.centres.push_back(
        {draw.uniform(0, 3), draw.uniform(0, 3), draw.uniform(0, 2), draw.uniform(0.5, 1.2)});
    Record<double> q{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1),
                     draw.uniform(-1, 1)};
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    grains.orientations.push_back({q.x / length, q.y / length, q.z / length, q.w / length});
  }
  grains.blocks.resize(blocks);
  for (PinacoidBlock& block : grains.blocks) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const auto a = static_cast<std::int32_t>(draw.below(100));
      block.set_grains(lane, a, static_cast<std::int32_t>(draw.below(100)));
    }
  }
  return grains;
}

// That the twin finds the right axes is tested against f64 in tests/engine/narrow.
TEST_CASE("the pinacoid kernel gives the bits of its plain-loop twin") {
  const PinacoidHalves shapes[] = {
      {0.5, 0.5, 0.21132486540518713, 0.5}, {0.75, 0.4, 0.5, 0.3}, {0.5, 0.5, 0, 0.5}};
  for (std::size_t k = 0; k < 6; ++k) {  // with themselves, and with the next one
    const PinacoidHalves &shape = shapes[k % 3], &other = shapes[(k + k / 3) % 3];
    for (const double period : {0.0, 3.0}) {
      const Grains grains = random_grains(50, 7);
      std::vector<PinacoidBlock> expected = grains.blocks;
      testing::pinacoid_axes_twin(shape, other, expected.data(), expected.size(),
                                  grains.centres.data(), grains.orientations.data(), period,
                                  period);
      for (const Isa isa : testing::testable_isas()) {
        INFO(name_of(isa) << ", ridges " << shape.c << " and " << other.c << ", period " << period);
        std::vector<PinacoidBlock> found = grains.blocks;
        kernels_for(isa).pinacoid_axes(shape, other, found.data(), found.size(),
                                       grains.centres.data(), grains.orientations.data(), period,
                                       period);
        REQUIRE(testing::same_bits(found, expected));
      }
    }
  }
}

TEST_CASE("no blocks are no work") {
  for (const Isa isa : testing::testable_isas()) {
    kernels_for(isa).pinacoid_axes({0.5, 0.5, 0.2, 0.5}, {0.5, 0.5, 0.2, 0.5}, nullptr, 0, nullptr,
                                   nullptr, 0, 0);
    SUCCEED(name_of(isa));
  }
}

}  // namespace
}  // namespace grainsweep
