#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/coordination.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

constexpr double tolerance = 1e-9;  // far above rounding, far below the next neighbours' gaps

Touching touching_of(SphereBed& bed, double within = tolerance) {
  return find_touching(bed, within, kernels_for(best_isa()));
}

TEST_CASE("a grain has 6 neighbours in a simple cubic block and 12 in a face-centred one") {
  SphereBed cubic = testing::simple_cubic_bed(4, 5, 8), fcc = testing::fcc_bed(3, 3, 6);
  const Coordination in_cubic = coordination(cubic, touching_of(cubic), {2, 6}, tolerance);
  const Coordination in_fcc = coordination(fcc, touching_of(fcc), {2, 6}, tolerance);
  CHECK(in_cubic.between_grains == 6);
  CHECK(in_cubic.with_walls == 6);
  CHECK(in_fcc.between_grains == 12);
  CHECK(in_fcc.with_walls == 12);
  CHECK(in_fcc.gap_tolerance == tolerance);
}

TEST_CASE("in the layer on the floor a neighbour is missing, or is the floor") {
  SphereBed cubic = testing::simple_cubic_bed(4, 5, 8);
  const Coordination layer = coordination(cubic, touching_of(cubic), {0, 1}, tolerance);
  CHECK(layer.between_grains == 5);
  CHECK(layer.with_walls == 6);
}

TEST_CASE("grains at side walls count them in one convention and not in the other") {
  SphereBed bed = make_bed({4, 2, periodic, walls}, {{1, 0.5, 5, 0.5}, {1, 1.5, 5, 0.5}});
  const Coordination both = coordination(bed, touching_of(bed), {4, 6}, tolerance);
  CHECK(both.between_grains == 1);
  CHECK(both.with_walls == 2);
}

TEST_CASE("a neighbour outside the slab counts for the grain inside") {
  SphereBed bed = make_bed({4, 4, periodic, walls}, {{2, 2, 1, 0.5}, {2, 2, 2, 0.5}});
  CHECK(coordination(bed, touching_of(bed), {0.5, 1.5}, tolerance).between_grains == 1);
}

TEST_CASE("a slab holds the centres from its bottom on, up to its top but not on it") {
  SphereBed bed =
      make_bed({4, 4, periodic, walls}, {{1, 1, 1, 0.5}, {1, 1, 2, 0.5}, {1, 1, 3, 0.5}});
  CHECK(coordination(bed, touching_of(bed), {2, 3}, tolerance).between_grains == 2);
  CHECK(coordination(bed, touching_of(bed), {1, 2}, tolerance).between_grains == 1);
  CHECK(coordination(bed, touching_of(bed), {1, 3}, tolerance).between_grains == 1.5);
}

TEST_CASE("a wider tolerance of the gap counts more neighbours") {
  SphereBed bed =
      make_bed({4, 4, periodic, walls}, {{1, 1, 1, 0.5}, {1, 1, 2.001, 0.5}, {1, 2.01, 1, 0.5}});
  const Touching touching = touching_of(bed, 0.05);
  const Slab slab{0.5, 1.5};
  CHECK(coordination(bed, touching, slab, 1e-4).between_grains == 0);
  CHECK(coordination(bed, touching, slab, 2e-3).between_grains == 0.5);
  CHECK(coordination(bed, touching, slab, 0.02).between_grains == 1.5);
}

TEST_CASE("a slab without grains has no coordination number") {
  SphereBed bed = make_bed({4, 4, periodic, walls}, {{1, 1, 1, 0.5}});
  const Coordination none = coordination(bed, touching_of(bed), {5, 6}, tolerance);
  CHECK(std::isnan(none.between_grains));
  CHECK(std::isnan(none.with_walls));
}

TEST_CASE("every grain knows how many it touches") {
  SphereBed fcc = testing::fcc_bed(3, 3, 4);
  const auto counts = neighbour_counts(fcc.grains(), touching_of(fcc), tolerance);
  CHECK(std::count(counts.begin(), counts.end(), 8) == 2 * 18);  // the lowest and the highest layer
  CHECK(std::count(counts.begin(), counts.end(), 12) == 6 * 18);
  CHECK(counts.size() == 8 * 18);
  CHECK(neighbour_counts(2, {{{0, 1, 0.5}}, {}}, 0.1) == std::vector<std::int32_t>{0, 0});
}

}  // namespace
}  // namespace grainsweep
