#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "engine/scene/size_distribution.hpp"
#include "engine/scene/sizes.hpp"
#include "engine/scene/spec.hpp"
#include "engine/units.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

SizeDistribution distribution_of(const SizeFormula& formula, SizeWeight by,
                                 std::optional<double> smallest = {},
                                 std::optional<double> largest = {}) {
  return {formula, by, smallest, largest};
}

/// A sieve curve of eight rows, as of a broken rock.
SizeTable sieve_table() {
  return {{0.25, 0.355, 0.5, 0.71, 1.0, 1.4, 2.0, 2.8},
          {0.0, 0.05, 0.13, 0.27, 0.48, 0.71, 0.92, 1.0},
          {}};
}

const std::vector<SizeFormula>& formulas() {
  static const std::vector<SizeFormula> all = {LognormalSizes{1.0, 0.3}, UniformSizes{0.4, 2.0},
                                               WeibullSizes{1.1, 3.5}, sieve_table(),
                                               SizeTable{{0.3, 1.0, 2.0}, {}, {0.2, 0.3, 0.5}}};
  return all;
}

constexpr SizeWeight all_weights[] = {SizeWeight::number, SizeWeight::area, SizeWeight::volume};

/// Largest difference of the share, by weight, of the drawn grains up to any size and `asked`.
template <class Asked>
double kolmogorov_distance(std::vector<double> diameters, SizeWeight by, Asked asked) {
  std::sort(diameters.begin(), diameters.end());
  double all = 0.0, up_to = 0.0, distance = 0.0;
  for (const double diameter : diameters) all += weight_of(by, diameter);
  for (std::size_t i = 0; i < diameters.size(); ++i) {
    // Just below each size and at it; grains of one size count together.
    if (i == 0 || diameters[i] > diameters[i - 1]) {
      distance = std::max(distance, std::abs(up_to - asked(std::nextafter(diameters[i], 0.0))));
    }
    up_to += weight_of(by, diameters[i]) / all;
    if (i + 1 == diameters.size() || diameters[i + 1] > diameters[i]) {
      distance = std::max(distance, std::abs(up_to - asked(diameters[i])));
    }
  }
  return distance;
}

/// The share by number that is finer than `diameter`, by adding up thin slices of the curve.
double number_share(const SizeCurve& curve, double diameter) {
  constexpr int slices = 200'000;
  double below = 0.0, all = 0.0;
  const double low = curve.diameters.front() * (1.0 - 1e-9), high = curve.diameters.back();
  double before = 0.0;
  for (int k = 1; k <= slices; ++k) {
    const double at = low + (high - low) * k / slices;
    const double middle = at - 0.5 * (high - low) / slices;
    const double share = (passing_at(curve, at) - before) / weight_of(curve.by, middle);
    before = passing_at(curve, at);
    all += share;
    if (at <= diameter) below += share;
  }
  return below / all;
}

TEST_CASE("drawn grains follow the curve by number within one grain, however it is weighted") {
  for (const SizeFormula& formula : formulas()) {
    const SizeCurve curve = curve_of(distribution_of(formula, SizeWeight::number));
    for (const std::int64_t count : {1, 7, 500, 8000}) {
      INFO("formula " << formula.index() << ", " << count << " grains");
      const auto drawn = draw_diameters(curve, count, 3);
      REQUIRE(drawn.size() == static_cast<std::size_t>(count));
      const double distance = kolmogorov_distance(drawn, SizeWeight::number,
                                                  [&](double d) { return passing_at(curve, d); });
      CHECK(distance <= 1.0 / static_cast<double>(count) + 1e-12);  // rounding
    }
  }
}

TEST_CASE("by area and volume the drawn shares are those of the curve within the largest grain's") {
  for (const SizeFormula& formula : formulas()) {
    for (const SizeWeight by : all_weights) {
      const SizeCurve curve = curve_of(distribution_of(formula, by));
      const auto drawn = draw_diameters(curve, 500, 11);
      double all = 0.0;
      for (const double diameter : drawn) all += weight_of(by, diameter);
      INFO("formula " << formula.index() << ", by " << static_cast<int>(by));
      CHECK(kolmogorov_distance(drawn, by, [&](double d) { return passing_at(curve, d); }) <=
            weight_of(by, curve.diameters.back()) / all);
    }
  }
}

// Slices and the step of the draw: 1 / 8000 and twice as much for what a slice holds.
TEST_CASE("a curve by volume is drawn by number as its grains are, each counted once") {
  for (const SizeFormula& formula : formulas()) {
    for (const SizeWeight by : all_weights) {
      const SizeCurve curve = curve_of(distribution_of(formula, by));
      const auto drawn = draw_diameters(curve, 8000, 5);
      for (const double share : {0.1, 0.5, 0.9}) {
        const double diameter = curve.diameters.front() +
                                share * (curve.diameters.back() - curve.diameters.front()) + 1e-3;
        const auto finer =
            std::count_if(drawn.begin(), drawn.end(), [&](double d) { return d <= diameter; });
        INFO("formula " << formula.index() << ", by " << static_cast<int>(by));
        CHECK(static_cast<double>(finer) / 8000 == about(number_share(curve, diameter), 4e-4));
      }
    }
  }
}

TEST_CASE("a lognormal curve by volume is one by number about a smaller median") {
  const double sigma = 0.3, cut = 10.0;  // so wide that the cut is nothing
  const auto drawn = draw_diameters(
      curve_of(distribution_of(LognormalSizes{1.0, sigma}, SizeWeight::volume, 1.0 / cut, cut)),
      8000, 1);
  const double median = std::exp(-3 * sigma * sigma);  // Hatch and Choate 1929
  const double distance = kolmogorov_distance(drawn, SizeWeight::number, [&](double d) {
    return 0.5 * std::erfc(-std::log(d / median) / (sigma * std::sqrt(2.0)));
  });
  CHECK(distance <= 1.0 / 8000 + 1e-4);  // rows follow the formula that well at the fine end
}

TEST_CASE("formulas without ends are cut where one in a thousand lies beyond") {
  const SizeCurve lognormal = curve_of(distribution_of(LognormalSizes{2.0, 0.4}, SizeWeight::area));
  CHECK(0.5 * std::erfc(-std::log(lognormal.diameters.front() / 2.0) / 0.4 / std::sqrt(2.0)) ==
        Approx(1e-3));
  CHECK(0.5 * std::erfc(std::log(lognormal.diameters.back() / 2.0) / 0.4 / std::sqrt(2.0)) ==
        Approx(1e-3));
  const SizeCurve weibull = curve_of(distribution_of(WeibullSizes{1.0, 3.0}, SizeWeight::volume));
  CHECK(1 - std::exp(-std::pow(weibull.diameters.front(), 3)) == Approx(1e-3));
  CHECK(std::exp(-std::pow(weibull.diameters.back(), 3)) == Approx(1e-3));
}

TEST_CASE("a narrow curve keeps to its formula however far apart its ends are") {
  constexpr double by_rows = 2e-4;  // straight lines between rows, up to 0.06 of a deviation apart
  for (const double sigma : {0.1, 0.01, 0.001}) {
    const SizeCurve curve =
        curve_of(distribution_of(LognormalSizes{1.0, sigma}, SizeWeight::number, 0.2, 5.0));
    CHECK(curve.diameters.front() == 0.2);
    CHECK(curve.diameters.back() == 5.0);
    for (double deviation = -4.0; deviation <= 4.0; deviation += 0.01) {
      const double passing = 0.5 * std::erfc(-deviation / std::sqrt(2.0));
      CHECK(std::abs(passing_at(curve, std::exp(sigma * deviation)) - passing) < by_rows);
    }
  }
  const SizeCurve steep =
      curve_of(distribution_of(WeibullSizes{1.0, 100.0}, SizeWeight::volume, 0.2, 5.0));
  for (double passing = 0.001; passing < 1.0; passing += 0.001) {
    const double diameter = std::pow(-std::log1p(-passing), 1.0 / 100.0);
    CHECK(std::abs(passing_at(steep, diameter) - passing) < by_rows);
  }
}

TEST_CASE("a cut curve is what is left of the whole one") {
  const SizeCurve whole = curve_of(distribution_of(sieve_table(), SizeWeight::volume));
  const SizeCurve cut = curve_of(distribution_of(sieve_table(), SizeWeight::volume, 0.4, 2.4));
  const double low = passing_at(whole, 0.4), left = passing_at(whole, 2.4) - low;
  for (const double diameter : {0.4, 0.45, 0.9, 2.0, 2.3, 2.4}) {
    CHECK(passing_at(cut, diameter) == Approx((passing_at(whole, diameter) - low) / left));
  }
  CHECK(cut.diameters.front() == 0.4);
  CHECK(cut.diameters.back() == 2.4);
  const SizeTable grades{{0.5, 1.0, 2.0}, {}, {0.25, 0.25, 0.5}};
  const SizeCurve two = curve_of(distribution_of(grades, SizeWeight::number, 0.6, 2.0));
  const auto drawn = draw_diameters(two, 300, 1);
  CHECK(std::count(drawn.begin(), drawn.end(), 2.0) == 200);
  CHECK(std::count(drawn.begin(), drawn.end(), 1.0) == 100);
}

TEST_CASE("sieves that hold nothing are no ends of a curve") {
  const SizeTable sieves{{0.1, 0.5, 1.0, 2.0, 9.0}, {0.0, 0.0, 0.4, 1.0, 1.0}, {}};
  const SizeCurve curve = curve_of(distribution_of(sieves, SizeWeight::volume));
  CHECK(curve.diameters == std::vector<double>{0.5, 1.0, 2.0});
}

TEST_CASE("grains of one size are what a lognormal curve of no width gives") {
  const auto drawn = draw_diameters(
      curve_of(distribution_of(LognormalSizes{1.0, 0.0}, SizeWeight::volume)), 100, 1);
  CHECK(std::count(drawn.begin(), drawn.end(), 1.0) == 100);
}

TEST_CASE("a curve that is cut to one length gives grains of that") {
  for (const SizeFormula& formula :
       {SizeFormula(LognormalSizes{1.0, 0.2}), SizeFormula(WeibullSizes{1.0, 3.0}),
        SizeFormula(UniformSizes{0.5, 1.5})}) {
    const SizeDistribution distribution = distribution_of(formula, SizeWeight::volume, 1.0, 1.0);
    CHECK(fault_of(distribution).empty());
    for (const double drawn : draw_diameters(curve_of(distribution), 5, 1)) CHECK(drawn == 1.0);
  }
}

TEST_CASE("every curve of a formula may be cut to one length of its own") {
  for (int k = 0; k < 200; ++k) {  // passing(1) and what is just below 1 often round to one number
    const double median = 0.9 + 0.001 * k, sigma = 0.15 + 0.005 * k;
    INFO(median << ", " << sigma);
    CHECK(fault_of(distribution_of(LognormalSizes{median, sigma}, SizeWeight::number, 1.0, 1.0)) ==
          "");
  }
  const auto fault = [](double length) {
    return fault_of(distribution_of(LognormalSizes{1.0, 0.1}, SizeWeight::number, length, length));
  };
  CHECK(fault(0.5).starts_with("smallest and largest leave nothing"));
  CHECK(fault(2.0).starts_with("smallest and largest leave nothing"));
  const SizeTable sieves{{0.5, 1.5, 2.0}, {0.0, 0.5, 1.0}, {}};
  CHECK(fault_of(distribution_of(sieves, SizeWeight::volume, 1.5, 1.5)) != "");
}

TEST_CASE("the mean cube is that of the drawn grains") {
  for (const SizeFormula& formula : formulas()) {
    for (const SizeWeight by : all_weights) {
      const SizeCurve curve = curve_of(distribution_of(formula, by));
      const auto drawn = draw_diameters(curve, 20'000, 1);
      double sum = 0.0, squares = 0.0;
      for (const double diameter : drawn) {
        const double cube = diameter * diameter * diameter;
        sum += cube, squares += cube * cube;
      }
      // Strata leave a share of 1 / n of the largest grains open; the rest is far below it.
      CHECK(sum / 20'000 == Approx(mean_cube(curve)).epsilon(1e-3));
      // The largest count for more here.
      CHECK(squares / sum == Approx(mean_cube_by_volume(curve)).epsilon(5e-3));
    }
  }
}

// As a sieve analysis of the grains tells it: the mass between two sieves, to a grain at either.
TEST_CASE("a sieve curve by mass goes in and comes out to the last grain") {
  const SizeTable table = sieve_table();
  PackingSpec spec;
  spec.fill = SolidHeight{9.95};
  spec.sizes.distribution = distribution_of(table, SizeWeight::volume);
  const auto radii = draw_radii(spec);
  REQUIRE(radii.size() == static_cast<std::size_t>(grain_count(spec)));
  double all = 0.0;
  for (const double radius : radii) all += sphere_volume(radius);
  CHECK(all / spec.box.floor_area() == Approx(9.95).epsilon(2e-3));  // a grain of 2.8 d: 11.5 d^3
  for (std::size_t k = 1; k < table.diameters.size(); ++k) {
    double between = 0.0;
    for (const double radius : radii) {
      const double diameter = 2.0 * radius;
      const bool is_here = diameter > table.diameters[k - 1] && diameter <= table.diameters[k];
      if (is_here) between += sphere_volume(radius);
    }
    const double wanted = (table.passing[k] - table.passing[k - 1]) * all;
    INFO("sieve " << table.diameters[k]);
    CHECK(std::abs(between - wanted) <= 1.5 * sphere_volume(table.diameters[k] / 2.0));
  }
}

TEST_CASE("the largest grain comes first, and one key gives one draw") {
  const SizeCurve curve = curve_of(distribution_of(sieve_table(), SizeWeight::volume));
  const auto drawn = draw_diameters(curve, 1000, 4);
  CHECK(std::is_sorted(drawn.rbegin(), drawn.rend()));
  CHECK(drawn == draw_diameters(curve, 1000, 4));
  CHECK(drawn != draw_diameters(curve, 1000, 5));
}

TEST_CASE("what is wrong with a distribution is said") {
  const auto fault = [](const SizeFormula& formula, std::optional<double> smallest = {},
                        std::optional<double> largest = {}) {
    return fault_of(distribution_of(formula, SizeWeight::volume, smallest, largest));
  };
  for (const SizeFormula& formula : formulas()) CHECK(fault(formula).empty());
  CHECK(fault(LognormalSizes{0.0, 0.3}).starts_with("lognormal.median must be positive"));
  CHECK(fault(LognormalSizes{1.0, -0.1}).starts_with("lognormal.sigma must lie in"));
  CHECK(fault(LognormalSizes{1.0, std::nan("")}).starts_with("lognormal.sigma must lie in"));
  CHECK(fault(UniformSizes{2.0, 1.0}).starts_with("uniform.to must be no smaller"));
  CHECK(fault(WeibullSizes{1.0, 0.0}).starts_with("weibull.shape must lie in"));
  CHECK(fault(WeibullSizes{1.0, 1.0}).starts_with("smallest must cut off more"));
  CHECK(fault(WeibullSizes{1.0, 1.0}, 0.2).empty());
  CHECK(fault(UniformSizes{2.0, 3.0}).starts_with("size is missing or wrong"));
  CHECK(fault(UniformSizes{0.5, 3.0}, 4.0).starts_with("smallest and largest leave nothing"));
  CHECK(fault(UniformSizes{0.5, 3.0}, -1.0).starts_with("smallest must be positive"));
  CHECK(fault(SizeTable{{1.0}, {}, {}}).starts_with("table needs one of passing and shares"));
  CHECK(fault(SizeTable{{1.0, 2.0}, {0.0, 1.0}, {0.5, 0.5}}).starts_with("table needs one of"));
  CHECK(fault(SizeTable{{1.0, 2.0}, {0.0, 0.5, 1.0}, {}}).starts_with("table.diameters must hold"));
  CHECK(fault(SizeTable{{1.0, 1.0}, {0.0, 1.0}, {}}).starts_with("table.diameters must be positi"));
  const std::string rises =
      "table.passing must rise from 0 to 1, the share finer than each diameter; ";
  CHECK(fault(SizeTable{{0.5, 1.0}, {0.1, 1.0}, {}}) ==
        rises + "begins at 0.1: add the largest diameter that nothing is finer than");
  CHECK(fault(SizeTable{{0.5, 1.0}, {0, 0.98}, {}}) ==
        rises + "ends at 0.98: add a diameter that all is finer than");
  CHECK(fault(SizeTable{{0.5, 1.0}, {0, 100}, {}}) ==
        rises + "ends at 100: divide percentages by 100");
  CHECK(fault(SizeTable{{0.5, 0.7, 0.8, 1.0}, {0, 0.5, 0.4, 1}, {}}) ==
        rises + "number 3 falls to 0.4 from 0.5");
  CHECK(fault(SizeTable{{0.5, 1.0, 1.5}, {0, 0.6, 0.5}, {}}) ==
        rises + "number 3 falls to 0.5 from 0.6");
  CHECK(fault(SizeTable{{0.5, 1.0}, {}, {0.5, 0.4}}) ==
        "table.shares must add up to 1, add up to 0.9");
  CHECK(fault(SizeTable{{0.5, 1.0}, {}, {30, 69}}) ==
        "table.shares must add up to 1, add up to 99: divide percentages by 100");
}

TEST_CASE("ends to give to a curve are told in the unit of its lengths") {
  const auto fault = [](std::optional<double> smallest, std::optional<double> largest = {}) {
    SizeDistribution sieved =
        distribution_of(SizeTable{{0.1, 1.0, 6.0}, {0, 0.5, 1}, {}}, SizeWeight::volume);
    sieved.size = 20.0;
    for (auto& [to, length] :
         {std::pair(&sieved.smallest, smallest), std::pair(&sieved.largest, largest)}) {
      if (length) *to = *length / sieved.size;
    }
    return fault_of(sieved);
  };
  CHECK(fault({}) ==
        "smallest must cut off more: the largest grain may be 50 times the smallest, has 0.1 to 6 "
        "d; give smallest 2.4 or more, in the unit in which d is 20");
  CHECK(fault(2.4).empty());
  CHECK(fault(400.0, 500.0) ==
        "smallest and largest leave nothing of the curve, which runs from 2 to 120, in the unit in "
        "which d is 20");
  CHECK(fault_of(distribution_of(UniformSizes{0.5, 1.5}, SizeWeight::volume, 20.0))
            .ends_with("from 0.5 to 1.5, in d; size says what d is where lengths are in another "
                       "unit"));
  CHECK(fault_of(distribution_of(UniformSizes{0.5, 60.0}, SizeWeight::volume))
            .ends_with("; largest must cut off more, too"));
}

TEST_CASE("the grains of one size at an end asked for are left") {
  const SizeTable table{{0.3, 1.0, 2.0}, {}, {0.2, 0.3, 0.5}};
  const SizeCurve curve = curve_of(distribution_of(table, SizeWeight::number, 1.0, 2.0));
  CHECK(mean_cube(curve) == Approx((0.3 * 1 + 0.5 * 8) / 0.8));
}

TEST_CASE("a lognormal curve of no width is one size, whatever ends are given") {
  const SizeCurve curve =
      curve_of(distribution_of(LognormalSizes{1.0, 0.0}, SizeWeight::volume, 0.5, 3.0));
  CHECK(curve.diameters.front() == 1.0);
  CHECK(curve.diameters.back() == 1.0);
}

TEST_CASE(
    "a size may have no share, and the largest may be as many times the smallest as is said") {
  const SizeTable gap{{0.5, 1.0, 2.0}, {}, {0.5, 0.0, 0.5}};
  CHECK(fault_of(distribution_of(gap, SizeWeight::number)) == "");
  CHECK(fault_of(distribution_of(UniformSizes{1.0, most_size_ratio}, SizeWeight::number)) == "");
}

}  // namespace
}  // namespace grainsweep
