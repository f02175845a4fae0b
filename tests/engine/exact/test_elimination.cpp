#include <algorithm>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/exact/elimination.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

struct DrawnBed {
  std::vector<Record<double>> centres;
  std::vector<GrainPair> pairs;
};

/// Grains at random; those nearer than `reach` are pairs.
DrawnBed drawn_bed(std::size_t grains, double side, double height, double reach) {
  Draw draw(grains);
  DrawnBed bed;
  for (std::size_t i = 0; i < grains; ++i) {
    bed.centres.push_back(
        {draw.uniform(0.0, side), draw.uniform(0.0, side), draw.uniform(0.0, height), 0.5});
  }
  for (std::size_t a = 0; a < grains; ++a) {
    for (std::size_t b = a + 1; b < grains; ++b) {
      const Record<double>&p = bed.centres[a], &q = bed.centres[b];
      const double dx = p.x - q.x, dy = p.y - q.y, dz = p.z - q.z;
      if (dx * dx + dy * dy + dz * dz < reach * reach) {
        bed.pairs.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
      }
    }
  }
  return bed;
}

/// What eliminating grains one after the other joins, by places in the order.
std::vector<std::set<std::int32_t>> filled_in(const DrawnBed& bed, const EliminationTree& tree) {
  std::vector<std::set<std::int32_t>> later(bed.centres.size());
  for (const GrainPair pair : bed.pairs) {
    const std::int32_t a = tree.place[static_cast<std::size_t>(pair.a)];
    const std::int32_t b = tree.place[static_cast<std::size_t>(pair.b)];
    later[static_cast<std::size_t>(std::min(a, b))].insert(std::max(a, b));
  }
  for (const std::set<std::int32_t>& own : later) {
    if (own.empty()) continue;
    later[static_cast<std::size_t>(*own.begin())].insert(std::next(own.begin()), own.end());
  }
  return later;
}

TEST_CASE("every grain is eliminated once, and what that fills in lies in its node or its border") {
  for (const auto& bed : {drawn_bed(0, 1, 1, 1), drawn_bed(1, 1, 1, 1), drawn_bed(200, 4, 12, 1.1),
                          drawn_bed(300, 30, 30, 1.0), drawn_bed(60, 1, 60, 1.6)}) {
    INFO(bed.centres.size() << " grains");
    const EliminationTree tree = dissect(bed.centres, bed.pairs);
    std::vector<std::int32_t> order;
    for (const EliminationNode& node : tree.nodes) {
      order.insert(order.end(), node.grains.begin(), node.grains.end());
    }
    REQUIRE(order.size() == bed.centres.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
      CHECK(tree.place[static_cast<std::size_t>(order[k])] == static_cast<std::int32_t>(k));
    }
    const auto later = filled_in(bed, tree);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto at = static_cast<std::size_t>(tree.node_of[static_cast<std::size_t>(order[k])]);
      const EliminationNode& node = tree.nodes[at];
      for (const std::int32_t place : later[k]) {
        const std::int32_t grain = order[static_cast<std::size_t>(place)];
        const bool own =
            std::find(node.grains.begin(), node.grains.end(), grain) != node.grains.end();
        const bool bordering =
            std::find(node.border.begin(), node.border.end(), grain) != node.border.end();
        CHECK((own || bordering));
      }
    }
  }
}

TEST_CASE("children come before their parents and hand their borders on to them") {
  const DrawnBed bed = drawn_bed(400, 5, 15, 1.1);
  const EliminationTree tree = dissect(bed.centres, bed.pairs);
  for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
    std::set<std::int32_t> known(tree.nodes[k].grains.begin(), tree.nodes[k].grains.end());
    known.insert(tree.nodes[k].border.begin(), tree.nodes[k].border.end());
    for (const std::int32_t child : tree.nodes[k].children) {
      if (child == EliminationNode::none) continue;
      REQUIRE(static_cast<std::size_t>(child) < k);
      for (const std::int32_t grain : tree.nodes[static_cast<std::size_t>(child)].border) {
        CHECK(known.count(grain) == 1);
      }
    }
  }
  CHECK(tree.nodes.back().border.empty());
}

TEST_CASE("a tall column is parted by few grains") {
  const DrawnBed bed = drawn_bed(1000, 2, 250, 1.1);
  const EliminationTree tree = dissect(bed.centres, bed.pairs);
  for (const EliminationNode& node : tree.nodes) CHECK(node.size() < 60);  // a few d of its length
}

TEST_CASE("a bed that meets itself around a periodic box is parted once, not twice") {
  constexpr int side = 6, height = 5;
  DrawnBed bed;  // grains on a cubic lattice, neighbours along x around the box, too
  const auto name = [](int x, int y, int z) {
    return static_cast<std::int32_t>((z * side + y) * side + x % side);
  };
  for (int z = 0; z < height; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        bed.centres.push_back({1.0 * x, 1.0 * y, 1.0 * z, 0.5});
        bed.pairs.push_back({name(x, y, z), name(x + 1, y, z)});
        if (y + 1 < side) bed.pairs.push_back({name(x, y, z), name(x, y + 1, z)});
        if (z + 1 < height) bed.pairs.push_back({name(x, y, z), name(x, y, z + 1)});
      }
    }
  }
  const EliminationTree tree = dissect(bed.centres, bed.pairs);
  // Across x, its first longest axis, 2 * 30 grains part it; across y 30. Across z, where halves of
  // 90 grains split the middle layer, no fewer do.
  CHECK(tree.nodes.back().grains.size() == side * height);
}

}  // namespace
}  // namespace grainsweep
