#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "runner/analysis/fit.hpp"
#include "tests/support/about.hpp"

namespace grainsweep {
namespace {

TEST_CASE("a fit through points on a line returns the line") {
  const auto fit = fit_line({{1, 5, 0.1}, {2, 7, 0.2}, {4, 11, 0.5}});
  REQUIRE(fit);
  CHECK(fit->intercept == Approx(3.0));
  CHECK(fit->slope == Approx(2.0));
  CHECK(fit->chi2 == Approx(0.0).margin(1e-20));
  CHECK(fit->degrees_of_freedom == 1);
  CHECK(fit->r_squared == Approx(1.0));
}

// Worked by hand: x = -1, 0, 1, y = 0, 0, 3, error 1: S_xx = 2, slope = 3/2, intercept = 1,
// residuals 1/2, -1, 1/2, chi2 = 3/2.
TEST_CASE("a weighted fit reproduces values and errors worked by hand") {
  const auto fit = fit_line({{-1, 0, 1}, {0, 0, 1}, {1, 3, 1}});
  REQUIRE(fit);
  CHECK(fit->slope == Approx(1.5));
  CHECK(fit->intercept == Approx(1.0));
  CHECK(fit->chi2 == Approx(1.5));
  CHECK(fit->slope_error == Approx(std::sqrt(0.5)));
  CHECK(fit->intercept_error == Approx(std::sqrt(1.0 / 3.0)));
  CHECK(fit->covariance == Approx(0.0).margin(1e-15));
  CHECK(fit->r_squared == Approx(1.0 - 1.5 / 6.0));
}

TEST_CASE("a point with a small error pulls harder") {
  const auto fit = fit_line({{0, 0, 1}, {1, 1, 1e-3}, {1, 3, 1}, {2, 2, 1e-3}});
  REQUIRE(fit);
  CHECK(fit->slope == about(1.0, 1e-4));
  CHECK(fit->intercept == Approx(0.0).margin(1e-4));
}

// 4000 noisy copies of a wall-effect line; the scatter of the fitted parameters must be what each
// fit claims as its error. 4 % is 3.5 standard deviations of a standard deviation of 4000 values.
TEST_CASE("planted parameters are recovered within the errors the fit claims") {
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  const std::vector<double> widths = {4, 5, 6, 8, 10, 15, 20};
  const int copies = 4000;
  double slopes = 0, slopes2 = 0, intercepts = 0, intercepts2 = 0, products = 0, chi2 = 0;
  LineFit last;
  for (int copy = 0; copy < copies; ++copy) {
    std::vector<LinePoint> points;
    for (double width : widths) {
      const double error = 0.001 + 0.004 / width;
      points.push_back({1 / width, 0.64 - 0.2 / width + error * normal(generator), error});
    }
    last = fit_line(points).value();
    const double slope = last.slope + 0.2, intercept = last.intercept - 0.64;
    slopes += slope, slopes2 += slope * slope, chi2 += last.chi2;
    intercepts += intercept, intercepts2 += intercept * intercept, products += slope * intercept;
  }
  CHECK(slopes / copies == Approx(0).margin(4 * last.slope_error / std::sqrt(copies)));
  CHECK(intercepts / copies == Approx(0).margin(4 * last.intercept_error / std::sqrt(copies)));
  CHECK(std::sqrt(slopes2 / copies) == Approx(last.slope_error).epsilon(0.04));
  CHECK(std::sqrt(intercepts2 / copies) == Approx(last.intercept_error).epsilon(0.04));
  CHECK(products / copies == Approx(last.covariance).epsilon(0.08));
  CHECK(chi2 / copies == Approx(5.0).epsilon(0.04));
}

TEST_CASE("points that do not determine a line give nothing") {
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK_FALSE(fit_line({}));
  CHECK_FALSE(fit_line({{1, 1, 1}, {2, 2, 1}}));
  CHECK_FALSE(fit_line({{1, 1, 1}, {1, 2, 1}, {1, 3, 1}}));
  CHECK_FALSE(fit_line({{1, 1, 0}, {2, 2, 1}, {3, 3, 1}}));
  CHECK_FALSE(fit_line({{1, 1, infinite}, {2, 2, 1}, {3, 3, 1}}));
  CHECK_FALSE(fit_line({{1, std::nan(""), 1}, {2, 2, 1}, {3, 3, 1}}));
}

// Worked by hand: the points above have chi2 = 3/2 for one degree of freedom, so that their errors
// of 1 become the root of 3/2.
TEST_CASE("points of one error scatter by what widens it by the root of chi2 per degree") {
  const auto fit = fit_scattered_line({{-1, 0, 1}, {0, 0, 1}, {1, 3, 1}});
  REQUIRE(fit);
  CHECK(fit->scatter == Approx(std::sqrt(0.5)));
  CHECK(fit->chi2 == Approx(1.5));
  CHECK(fit->slope == Approx(1.5));
  CHECK(fit->intercept == Approx(1.0));
  CHECK(fit->slope_error == Approx(std::sqrt(0.75)));
  CHECK(fit->intercept_error == Approx(std::sqrt(0.5)));
}

TEST_CASE("points that miss the line by less than their errors do not scatter about it") {
  const std::vector<LinePoint> points = {{-1, 0, 2}, {0, 0, 2}, {1, 3, 2}};
  const auto fit = fit_scattered_line(points), plain = fit_line(points);
  REQUIRE(fit);
  CHECK(fit->scatter == 0.0);
  CHECK(fit->slope_error == plain->slope_error);
  CHECK_FALSE(fit_scattered_line({{1, 1, 1}, {2, 2, 1}}));
}

// Two points known to 1e-6 beside others known to 0.1, all of which scatter by 1: the plain line
// goes through the two.
TEST_CASE("two points of tiny error do not decide alone on a line about which all scatter") {
  const std::vector<LinePoint> points = {{0, 1, 1e-6}, {1, -1, 1e-6}, {2, 3, 0.1},
                                         {3, 2, 0.1},  {4, 5, 0.1},   {5, 4, 0.1}};
  CHECK(fit_line(points)->slope == about(-2.0, 1e-3));
  const auto fit = fit_scattered_line(points);
  REQUIRE(fit);
  CHECK(fit->chi2 == fit_line(points)->chi2);
  std::vector<LinePoint> wider = points;
  for (LinePoint& point : wider) point.error = std::hypot(point.error, fit->scatter);
  CHECK(fit_line(wider)->chi2 == Approx(4.0));  // its degrees of freedom
  CHECK(fit->slope == Approx(fit_line(wider)->slope));
  // The unweighted line: x_m = 5/2, S_xx = 35/2, S_xy = 16, S_yy = 70/3.
  CHECK(fit->slope == Approx(16 / 17.5).epsilon(0.02));
  CHECK(fit->scatter == Approx(std::sqrt((70.0 / 3.0 - 16 * 16 / 17.5) / 4)).epsilon(0.02));
}

// Of two degrees of freedom chi2 is larger than x with probability exp(-x / 2), of one with that of
// a normal deviate beyond its root to either side: 0.005 beyond 2.8070.
TEST_CASE("a misfit that chance exceeds in one case of 200 is not put down to it") {
  const double of_two = -2.0 * std::log(0.005) / 2.0, of_one = 2.807033768 * 2.807033768;
  for (const double share : {0.0, 0.5, 0.9999}) {
    CHECK(may_hold({share * of_two, 2}));
    CHECK(may_hold({share * of_one, 1}));
  }
  CHECK_FALSE(may_hold({1.0001 * of_two, 2}));
  CHECK_FALSE(may_hold({1.0001 * of_one, 1}));
}

TEST_CASE("errors known from few values make more of a misfit chance") {
  // Quantiles of tables: F(2, 4) and F(1, 12) to 0.995, Student's of 4 and 12 to 0.975.
  const auto limit = [](double f, double student) { return f * std::pow(1.959964 / student, 2); };
  const double of_two = limit(26.2843, 2.776445), of_one = limit(11.7542, 2.178813);
  CHECK(may_hold({0.9999 * of_two, 2, 4.0}));
  CHECK(may_hold({0.9999 * of_one, 1, 12.0}));
  CHECK_FALSE(may_hold({1.0001 * of_two, 2, 4.0}));
  CHECK_FALSE(may_hold({1.0001 * of_one, 1, 12.0}));
  // From very many values they are known as they are.
  const double many = -std::log(0.005);
  CHECK(may_hold({0.999 * many, 2, 1e6}));
  CHECK_FALSE(may_hold({1.001 * many, 2, 1e6}));
}

TEST_CASE("a line goes through narrow containers only where three others are not left") {
  CHECK(widths_on_line({{2, true}, {4, false}, {5, false}, {6, false}}) ==
        std::vector<bool>{false, true, true, true});
  CHECK(widths_on_line({{2, true}, {5, false}, {6, false}, {6, false}}) ==
        std::vector<bool>{true, true, true, true});  // two widths
  CHECK(widths_on_line({{2, true}, {3, true}}) == std::vector<bool>{true, true});
  CHECK(widths_on_line({}).empty());
}

TEST_CASE("a constant y has a fit but no share of variance to explain") {
  const auto fit = fit_line({{1, 2, 1}, {2, 2, 1}, {3, 2, 1}});
  REQUIRE(fit);
  CHECK(fit->slope == Approx(0.0).margin(1e-15));
  CHECK(std::isnan(fit->r_squared));
}

}  // namespace
}  // namespace grainsweep
