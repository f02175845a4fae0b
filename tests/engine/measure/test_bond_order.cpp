#include <cmath>
#include <complex>

#include <catch2/catch.hpp>

#include "engine/measure/bond_order.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::Draw;
using testing::periodic;
using testing::walls;

/// By the definition, with the library's spherical harmonics.
double q6_by_definition(const std::vector<Vector>& bonds) {
  double squares = 0;
  for (int m = -6; m <= 6; ++m) {
    std::complex<double> mean = 0;
    for (const Vector& u : bonds) {
      const auto order = static_cast<unsigned>(std::abs(m));
      const double polar = std::sph_legendre(6U, order, std::acos(u.z()));
      mean += polar * std::polar(1.0, m * std::atan2(u.y(), u.x())) / double(bonds.size());
    }
    squares += std::norm(mean);
  }
  return std::sqrt(4 * pi / 13 * squares);
}

std::vector<Vector> random_bonds(Draw& draw, int count) {
  std::vector<Vector> bonds;
  for (int k = 0; k < count; ++k) {
    const auto u = draw.direction();
    bonds.emplace_back(u.x, u.y, u.z);
  }
  return bonds;
}

/// Of pairs of grains that touch in these directions, far from each other, and of a single grain.
BondOrder order_of(const std::vector<Vector>& bonds) {
  std::vector<PlacedSphere> spheres = {{2, 2, 8, 0.5}};  // no bond, no order
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const double x = 4.0 * double(k % 20) + 2, y = 4.0 * double(k / 20) + 2;
    const Vector& u = bonds[k];
    spheres.push_back({x, y, 4, 0.5});
    spheres.push_back({x + u.x(), y + u.y(), 4 + u.z(), 0.5});
  }
  SphereBed bed = make_bed({80, 80, periodic, walls}, spheres);
  const Touching near = find_touching(bed, longest_bond_gap, kernels_for(best_isa()));
  return bond_order(bed, near, {0, 9});
}

TEST_CASE("the bond order is that of the definition") {
  Draw draw(1);
  for (const int count : {1, 2, 5, 12, 100}) {
    const auto bonds = random_bonds(draw, count);
    CHECK(order_of(bonds).global == Approx(q6_by_definition(bonds)).epsilon(1e-12));
  }
}

// Steinhardt, Nelson, Ronchetti (1983), table I.
TEST_CASE("bonds of a simple cubic lattice and of an icosahedron have their known order") {
  CHECK(order_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}).global ==
        Approx(std::sqrt(1.0 / 8.0)).epsilon(1e-12));
  const double g = (1 + std::sqrt(5.0)) / 2, r = std::sqrt(1 + g * g), a = 1 / r, b = g / r;
  CHECK(order_of({{0, a, b}, {0, a, -b}, {a, b, 0}, {a, -b, 0}, {b, 0, a}, {b, 0, -a}}).global ==
        about(0.66332, 1e-5));
}

TEST_CASE("a face-centred block has the order of its lattice, globally and locally") {
  SphereBed bed = testing::fcc_bed(3, 3, 4);
  const Touching near = find_touching(bed, longest_bond_gap, kernels_for(best_isa()));
  const BondOrder order = bond_order(bed, near, {1.2, 4.2});
  CHECK(order.global == about(0.574524, 1e-6));
  CHECK(order.local == about(0.574524, 1e-6));
}

TEST_CASE("order of single grains without common direction is local only") {
  // Each grain has one bond, of Q6 = 1.
  Draw draw(7);
  const BondOrder order = order_of(random_bonds(draw, 400));
  CHECK(order.local == Approx(1.0));
  CHECK(order.global < 3.0 / std::sqrt(400.0));  // a mean of 400 random directions
}

TEST_CASE("grains are bonded up to a fifth of their mean diameter") {
  CHECK(bond_gap(0.5, 0.5) == 0.2);
  CHECK(bond_gap(0.25, 0.25) == 0.1);
  CHECK(bond_gap(2, 2) == longest_bond_gap);
  for (const double distance : {1.19, 1.21}) {
    SphereBed bed = make_bed({9, 9, periodic, walls}, {{2, 2, 3, 0.5}, {2 + distance, 2, 3, 0.5}});
    const Touching near = find_touching(bed, longest_bond_gap, kernels_for(best_isa()));
    CHECK(std::isnan(bond_order(bed, near, {0, 9}).global) == (distance > 1.2));
  }
}

}  // namespace
}  // namespace grainsweep
