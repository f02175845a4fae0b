#include <cmath>

#include <catch2/catch.hpp>

#include "engine/measure/pair_correlation.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"
#include "tests/support/draw.hpp"
#include "tests/support/scenes.hpp"

namespace grainsweep {
namespace {

using testing::periodic;
using testing::walls;

// Points at random have g = 1 at every distance, in every kind of box, with the noise of the number
// of pairs in a bin: about 2000 beds' pairs here, so that 4 / sqrt(pairs) is four deviations.
TEST_CASE("points at random have no correlation, whatever bounds the region") {
  for (const Box& box : {Box{8, 8, periodic, periodic}, Box{8, 4, periodic, walls},
                         Box{5, 4, walls, walls}, Box{3, 9, walls, periodic}}) {
    const Slab slab{0.5, 5.5};
    std::vector<double> sum;
    const int beds = 40;
    for (int k = 0; k < beds; ++k) {
      const auto seed = static_cast<std::uint64_t>(k + 1);
      const SphereBed bed = testing::random_bed({box, 800, 0.1, 0.5, 6, seed});
      const Curve curve = pair_correlation(bed, slab, 0.5, 2.5);
      sum.resize(curve.values.size());
      for (std::size_t bin = 0; bin < sum.size(); ++bin) sum[bin] += curve.values[bin] / beds;
    }
    REQUIRE(sum.size() == 5);
    for (std::size_t bin = 0; bin < sum.size(); ++bin) {
      const double middle = 0.5 * (double(bin) + 0.5), volume = box.length * box.width * 5;
      const double n = 800 * 5.0 / 6.0;
      const double pairs = beds * n * n / 2 * 4 * pi * middle * middle * 0.5 / volume / 2;
      INFO(box.length << " x " << box.width << ", bin " << bin);
      CHECK(sum[bin] == about(1, 4 / std::sqrt(pairs) + 0.004));
    }
  }
}

TEST_CASE("points at random in a tube have no correlation, however narrow it is") {
  testing::Draw draw(77);
  for (const double diameter : {0.6, 3.0, 9.0}) {
    const Slab slab{0.5, 5.5};
    std::vector<double> sum(5, 0.0);
    const int beds = 60, points = 400;
    for (int k = 0; k < beds; ++k) {
      std::vector<PlacedSphere> spheres;
      while (spheres.size() < points) {
        const PlacedSphere s{draw.uniform(0, diameter), draw.uniform(0, diameter),
                             draw.uniform(slab.bottom, slab.top), 0.1};
        if (std::hypot(s.x - diameter / 2, s.y - diameter / 2) < diameter / 2) spheres.push_back(s);
      }
      const SphereBed bed = make_bed(tube_of(diameter), spheres);
      const Curve curve = pair_correlation(bed, slab, 0.5, 2.5);
      REQUIRE(curve.values.size() == sum.size());
      for (std::size_t bin = 0; bin < sum.size(); ++bin) sum[bin] += curve.values[bin] / beds;
    }
    for (std::size_t bin = 0; bin < sum.size(); ++bin) {
      // At least so many pairs in each bin: a tenth of them all in the narrow tube, 1 % in the
      // wide.
      const double pairs = beds * 0.5 * points * points * (diameter > 4 ? 0.0012 : 0.01);
      INFO("D = " << diameter << ", bin " << bin);
      CHECK(sum[bin] == about(1, 4 / std::sqrt(pairs) + 0.006));
    }
  }
}

/// Pairs at each distance, every pair and image looked at.
std::vector<double> pairs_by_brute_force(const SphereBed& bed, const Slab& slab, double bin_width,
                                         std::size_t bins) {
  std::vector<double> counts(bins, 0.0);
  for (std::size_t a = 0; a < bed.grains(); ++a) {
    for (std::size_t b = a + 1; b < bed.grains(); ++b) {
      const auto &p = bed.position[a], &q = bed.position[b];
      if (std::min(p.z, q.z) < slab.bottom || std::max(p.z, q.z) >= slab.top) continue;
      double least = 1e9;
      for (int i = -1; i <= 1; ++i) {
        const double y = p.y - q.y;
        least = std::min(least, std::hypot(p.x - q.x + i * bed.box.period_x(), y, p.z - q.z));
      }
      const auto bin = static_cast<std::size_t>(least / bin_width);
      if (bin < bins) counts[bin] += 1;
    }
  }
  return counts;
}

/// Number of the bed's centres in the slab and how far they spread across and along.
struct Spread {
  double n = 0, x = 0, y = 0;
};
Spread spread_in(const SphereBed& bed, const Slab& slab) {
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9, n = 0;
  for (std::size_t i = 0; i < bed.grains(); ++i) {
    const auto& p = bed.position[i];
    if (p.z < slab.bottom || p.z >= slab.top) continue;
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
    n += 1;
  }
  return {n, high_x - low_x, high_y - low_y};
}

/// Counts the pairs that a curve stands for in bins of 0.25 d and compares them with all there are.
/// `covered(r)`: integral, over the ball of radius r, of how much of the region is left for the
/// first grain of a pair when the second one must lie in it, too.
template <class Covered>
void check_pairs(const SphereBed& bed, const Slab& slab, double volume, const Covered& covered) {
  const Curve curve = pair_correlation(bed, slab, 0.25, 3);
  const auto counts = pairs_by_brute_force(bed, slab, 0.25, curve.values.size());
  REQUIRE(curve.values.size() == 12);
  const double n = spread_in(bed, slab).n;
  for (std::size_t k = 0; k < 12; ++k) {
    const double share = covered(0.25 * double(k + 1)) - covered(0.25 * double(k));
    const double expected = n * (n - 1) / 2 * share / (volume * volume);
    CHECK(curve.values[k] * expected == Approx(counts[k]).epsilon(1e-9));
  }
}

// The normalisation is the same for all beds of a region and a number of grains: what is left is
// the count. u: a direction; its components are 1/2 in the mean, the product of two 2/(3 pi) and of
// all three 1/(4 pi).
TEST_CASE("pairs are counted as by a search over all of them") {
  const Slab slab{1, 5};
  const double h = slab.height();
  const SphereBed bed = testing::random_bed({{6, 4, periodic, walls}, 300, 0.2, 0.5, 6, 3});
  const double e = spread_in(bed, slab).y;
  check_pairs(bed, slab, 6 * e * h, [&](double r) {  // of L (e - r |u_y|)(h - r |u_z|)
    return 4 * pi * 6 *
           (e * h * std::pow(r, 3) / 3 - (e + h) / 2 * std::pow(r, 4) / 4 +
            2 / (3 * pi) * std::pow(r, 5) / 5);
  });
}

TEST_CASE("pairs between four walls are counted as by a search over all of them") {
  const Slab slab{1, 5};
  const double h = slab.height();
  const SphereBed bed = testing::random_bed({{5, 4, walls, walls}, 300, 0.2, 0.5, 6, 3});
  const auto [n, d, e] = spread_in(bed, slab);
  check_pairs(bed, slab, d * e * h, [d = d, e = e, h](double r) {
    return 4 * pi *  // of (d - r |u_x|)(e - r |u_y|)(h - r |u_z|)
           (d * e * h * std::pow(r, 3) / 3 - (d * e + d * h + e * h) / 2 * std::pow(r, 4) / 4 +
            (d + e + h) * 2 / (3 * pi) * std::pow(r, 5) / 5 - std::pow(r, 6) / 6 / (4 * pi));
  });
}

TEST_CASE("spheres of a lattice stand at its distances only") {
  const SphereBed bed = testing::simple_cubic_bed(8, 8, 8);
  const Curve curve = pair_correlation(bed, {0, 8}, 0.05, 2.1);
  for (std::size_t k = 0; k < curve.values.size(); ++k) {
    bool has_lattice_distance = false;
    for (const double d : {1.0, std::sqrt(2.0), std::sqrt(3.0), 2.0}) {
      const double low = 0.05 * double(k);
      has_lattice_distance |= d > low - 1e-9 && d < low + 0.05 + 1e-9;
    }
    INFO(k);
    if (!has_lattice_distance) CHECK(curve.values[k] == 0);
  }
  CHECK(curve.values[20] + curve.values[19] > 1);
}

TEST_CASE("the curve ends where half a period or the region does") {
  const SphereBed narrow = testing::random_bed({{4, 9, periodic, walls}, 99, 0.5, 0.5, 9, 2});
  CHECK(pair_correlation(narrow, {0, 9}, 0.25, 5).values.size() == 8);
  CHECK(pair_correlation(narrow, {0, 1}, 0.25, 5).values.size() == 4);
  const SphereBed lone = make_bed({4, 9, periodic, walls}, {{1, 1, 1, 0.5}});
  CHECK(pair_correlation(lone, {0, 9}, 0.25, 5).values.empty());
  CHECK(pair_correlation(narrow, {0, 9}, 0.1, 0.3).values.size() == 3);  // 0.3 / 0.1 is below 3
}

// As while they move, before they are wrapped.
TEST_CASE("grains a little beyond a periodic side are in the curve where their images are") {
  SphereBed bed = testing::random_bed({{8, 8, periodic, periodic}, 200, 0.5, 0.5, 6, 4});
  const Curve within = pair_correlation(bed, {1, 5}, 0.25, 2);
  for (std::size_t i = 0; i < bed.grains(); i += 2) {
    Record<double>& p = bed.position[i];
    p.x += p.x < 1 ? 8 : 0;
    p.y += p.y < 1 ? 8 : 0;
  }
  const Curve beyond = pair_correlation(bed, {1, 5}, 0.25, 2);
  REQUIRE(within.values.size() == beyond.values.size());
  for (std::size_t k = 0; k < within.values.size(); ++k) {
    CHECK(beyond.values[k] == Approx(within.values[k]).epsilon(1e-12));
  }
}

}  // namespace
}  // namespace grainsweep
