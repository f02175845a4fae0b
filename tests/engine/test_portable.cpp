#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/portable.hpp"
#include "tests/support/draw.hpp"

namespace grainsweep {
namespace {

/// By how many units in the last place of its nearest double a value is off what is exact to 64
/// bits.
double units_off(double value, long double exact) {
  const double nearest = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) / unit);
}

// Half a unit is what rounding leaves; the long double that it is compared with is off by a 2048th
// at most, of powers by a 500th.
constexpr double half_a_unit = 0.501, half_of_power = 0.505;

TEST_CASE("portable functions are rounded to the nearest number") {
  testing::Draw draw(7);
  for (int k = 0; k < 2000; ++k) {
    const double x = draw.uniform(-6, 6), positive = std::exp(x), share = draw.uniform(-1, 1);
    CAPTURE(x, share);
    CHECK(units_off(portable::exp(x), std::exp(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::expm1(x), std::expm1(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::log(positive), std::log(static_cast<long double>(positive))) <=
          half_a_unit);
    CHECK(units_off(portable::log1p(share), std::log1p(static_cast<long double>(share))) <=
          half_a_unit);
    CHECK(units_off(portable::cbrt(x), std::cbrt(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::sin(x), std::sin(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::cos(x), std::cos(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::tan(x), std::tan(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::atan(x), std::atan(static_cast<long double>(x))) <= half_a_unit);
    CHECK(units_off(portable::acos(share), std::acos(static_cast<long double>(share))) <=
          half_a_unit);
    CHECK(units_off(portable::erfc(x), std::erfc(static_cast<long double>(x))) <= half_of_power);
    CHECK(units_off(portable::pow(positive, share), std::pow(static_cast<long double>(positive),
                                                             static_cast<long double>(share))) <=
          half_of_power);
  }
}

TEST_CASE("portable functions take what has no digits as those of the standard library do") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  CHECK(portable::log(0.0) == -infinite);
  CHECK(std::isnan(portable::log(-1.0)));
  CHECK(portable::exp(-infinite) == 0.0);
  CHECK(portable::exp(1e3) == infinite);
  CHECK(portable::pow(0.0, 0.0) == 1.0);
  CHECK(std::isnan(portable::acos(1.5)));
  CHECK(std::signbit(portable::sin(-0.0)));
}

}  // namespace
}  // namespace grainsweep
