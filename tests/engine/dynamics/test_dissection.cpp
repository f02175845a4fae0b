#include <algorithm>
#include <set>

#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>

#include "engine/dynamics/dissection.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/tries.hpp"

namespace grainsweep {
namespace {

using testing::Draw;

using Pairs = std::vector<GrainPair>;

struct Lattice {
  std::vector<Record<double>> centres;
  Pairs contacts;

  std::vector<std::int32_t> order() const { return elimination_order(centres, contacts); }
  Pairs in_order() const {
    Pairs sorted;
    for (const std::int32_t k : order()) sorted.push_back(contacts[static_cast<std::size_t>(k)]);
    return sorted;
  }
};

/// A cubic lattice of grains, their contacts with their neighbours, and of the lowest layer with
/// the floor, in random order.
Lattice lattice(int side) {
  Lattice all;
  Pairs& contacts = all.contacts;
  const auto grain = [&](int x, int y, int z) { return (z * side + y) * side + x; };
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const std::int32_t a = grain(x, y, z);
        all.centres.push_back({x + 0.0, y + 0.0, z + 0.0, 0.5});
        if (x + 1 < side) contacts.push_back({a, grain(x + 1, y, z)});
        if (y + 1 < side) contacts.push_back({a, grain(x, y + 1, z)});
        if (z + 1 < side) contacts.push_back({a, grain(x, y, z + 1)});
        if (z == 0) contacts.push_back({a, a});
      }
    }
  }
  Draw(7).shuffle(contacts);
  return all;
}

bool share_a_grain(GrainPair p, GrainPair q) {
  return q.a == p.a || q.a == p.b || q.b == p.a || q.b == p.b;
}
/// A regular matrix whose entries are the contacts that share a grain.
Eigen::SparseMatrix<double> matrix_of(const Pairs& contacts) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto size = static_cast<int>(contacts.size());
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      const bool joined = share_a_grain(contacts[static_cast<std::size_t>(i)],
                                        contacts[static_cast<std::size_t>(j)]);
      if (joined) entries.emplace_back(i, j, i == j ? 20.0 : 1.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Ordering>
Eigen::Index factor_entries(const Eigen::SparseMatrix<double>& matrix) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Ordering> factors(matrix);
  REQUIRE(factors.info() == Eigen::Success);
  return factors.matrixL().nestedExpression().nonZeros();
}

TEST_CASE("every contact is eliminated once") {
  for (const int side : {1, 2, 3, 9}) {
    const Lattice all = lattice(side);
    std::vector<std::int32_t> order = all.order();
    REQUIRE(order.size() == all.contacts.size());
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) {
      CHECK(order[k] == static_cast<std::int32_t>(k));
    }
  }
  CHECK(elimination_order({}, {}).empty());
}

TEST_CASE("contacts at one place, or all of one grain, are ordered, too") {
  const std::vector<Record<double>> twins(2, {1.0, 1.0, 1.0, 0.5});
  CHECK(elimination_order(twins, Pairs(300, {0, 1})).size() == 300);
  std::vector<Record<double>> centres = {{0.0, 0.0, 0.0, 0.5}};
  Pairs star;
  for (std::int32_t k = 1; k <= 300; ++k) {
    centres.push_back({k + 0.0, 0.0, 0.0, 0.5});
    star.push_back({0, k});
  }
  CHECK(elimination_order(centres, star).size() == 300);
}

// A third of a lattice's contacts, and more, are cut off from another third by those that come
// last.
TEST_CASE("the last contacts part the others") {
  const Pairs sorted = lattice(10).in_order();
  std::size_t apart = 0;
  for (std::size_t cut = sorted.size() / 3; cut < 2 * sorted.size() / 3; ++cut) {
    std::set<std::int32_t> before;
    for (std::size_t k = 0; k < cut; ++k) before.insert({sorted[k].a, sorted[k].b});
    std::size_t after = cut;
    while (after < sorted.size() && before.count(sorted[after].a) == 0 &&
           before.count(sorted[after].b) == 0) {
      ++after;
    }
    apart = std::max(apart, after - cut);
  }
  CHECK(apart > sorted.size() / 3);
}

TEST_CASE("factors have fewer entries than by minimum degree") {
  for (const int side : {10, testing::is_sanitized ? 11 : 14}) {
    const Lattice all = lattice(side);
    const Eigen::Index dissected =
        factor_entries<Eigen::NaturalOrdering<int>>(matrix_of(all.in_order()));
    const Eigen::Index degrees = factor_entries<Eigen::AMDOrdering<int>>(matrix_of(all.contacts));
    INFO("side " << side << ": " << dissected << " and " << degrees);
    CHECK(dissected < degrees);
  }
}

}  // namespace
}  // namespace grainsweep
