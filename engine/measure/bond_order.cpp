#include "engine/measure/bond_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "engine/units.hpp"

namespace grainsweep {

namespace {

constexpr double bond_share = 0.2;  // of the mean diameter: short of second neighbours in crystals

/// Sums of Y6m over bonds for m = 0 .. 6; those of -m have the same magnitude.
struct Harmonics {
  std::array<std::complex<double>, 7> sum{};
  double bonds = 0.0;
};

/// The spherical harmonics of degree six as polynomials of the unit vector.
void add(const Vector& u, Harmonics& harmonics) {
  const double z = u.z(), z2 = z * z;
  const std::array<double, 7> factor = {
      std::sqrt(13.0 / pi) / 32.0 * (((231.0 * z2 - 315.0) * z2 + 105.0) * z2 - 5.0),
      std::sqrt(273.0 / (2.0 * pi)) / 16.0 * ((33.0 * z2 - 30.0) * z2 + 5.0) * z,
      std::sqrt(1365.0 / pi) / 64.0 * ((33.0 * z2 - 18.0) * z2 + 1.0),
      std::sqrt(1365.0 / pi) / 32.0 * (11.0 * z2 - 3.0) * z,
      std::sqrt(91.0 / (2.0 * pi)) * 3.0 / 32.0 * (11.0 * z2 - 1.0),
      std::sqrt(1001.0 / pi) * 3.0 / 32.0 * z,
      std::sqrt(3003.0 / pi) / 64.0};
  std::complex<double> power(1.0, 0.0);
  for (std::size_t m = 0; m < factor.size(); ++m) {
    harmonics.sum[m] += factor[m] * power;
    power *= std::complex<double>(u.x(), u.y());
  }
  harmonics.bonds += 1.0;
}

double invariant(const Harmonics& harmonics) {
  if (harmonics.bonds == 0.0) return std::numeric_limits<double>::quiet_NaN();
  double squares = std::norm(harmonics.sum[0]);
  for (std::size_t m = 1; m < harmonics.sum.size(); ++m) {
    squares += 2.0 * std::norm(harmonics.sum[m]);
  }
  return std::sqrt(4.0 * pi / 13.0 * squares) / harmonics.bonds;
}

Vector direction(const Grains& bed, std::size_t a, std::size_t b) {
  const Vector r = nearest_difference(bed, a, b);
  return r / std::sqrt(r.x() * r.x() + r.y() * r.y() + r.z() * r.z());
}

/// Sums over the bonds of each grain.
std::vector<Harmonics> harmonics_of_grains(const Grains& bed, const Touching& near) {
  std::vector<Harmonics> grains(bed.grains());
  for (const TouchingPair& pair : near.pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (pair.gap >= bond_gap(bed.position[a].w, bed.position[b].w)) continue;
    const Vector u = direction(bed, a, b);
    add(u, grains[a]);  // the degree is even: u and -u count alike
    add(u, grains[b]);
  }
  return grains;
}

}  // namespace

double bond_gap(double radius_a, double radius_b) {
  return std::min(bond_share * (radius_a + radius_b), longest_bond_gap);
}

BondOrder bond_order(const Grains& bed, const Touching& near, const Slab& slab) {
  Harmonics all;
  double local = 0.0, grains = 0.0;
  const std::vector<Harmonics> each = harmonics_of_grains(bed, near);
  for (std::size_t i = 0; i < each.size(); ++i) {
    if (!slab.contains(bed.position[i].z) || each[i].bonds == 0.0) continue;
    for (std::size_t m = 0; m < all.sum.size(); ++m) all.sum[m] += each[i].sum[m];
    all.bonds += each[i].bonds;
    local += invariant(each[i]);
    grains += 1.0;
  }
  return {invariant(all), local / grains};  // 0 / 0 is NaN
}

}  // namespace grainsweep
