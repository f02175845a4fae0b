#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "runner/compare/formula.hpp"

namespace grainsweep {
namespace {

TEST_CASE("formulas are read as sources print them, with d as the unit of length") {
  const std::string dixon = "0.4 + 0.05*d/D + 0.412*(d/D)^2";
  CHECK(fault_of_formula(dixon).empty());
  CHECK(symbol_of_formula(dixon) == "D");
  CHECK(value_of_formula(dixon, 2.0) == Approx(0.528).epsilon(1e-12));
  CHECK(value_of_formula("0.64 - 0.2/W", 5.0) == Approx(0.6).epsilon(1e-12));
  CHECK(symbol_of_formula("0.64 - 0.2/W") == "W");
  CHECK(value_of_formula("exp(-W) + pi", 2.0) ==
        Approx(std::exp(-2.0) + std::numbers::pi).epsilon(1e-12));
}

TEST_CASE("a formula may have no number somewhere") {
  const std::string file = "1 - 2/3/D^3/sqrt(2/D - 1)";
  CHECK(fault_of_formula(file).empty());
  CHECK(value_of_formula(file, 1.0) == Approx(1.0 / 3.0).epsilon(1e-12));
  CHECK_FALSE(std::isfinite(value_of_formula(file, 2.0)));
  CHECK_FALSE(std::isfinite(value_of_formula(file, 3.0)));
}

TEST_CASE("of a formula that cannot be read the place is told, and how to write one") {
  const std::string how = "; write products with *, powers with ^: 0.4 + 0.05*d/D + 0.412*(d/D)^2";
  CHECK(fault_of_formula("0.4 + 0.05 d/D") == "no formula, at character 12" + how);
  CHECK(fault_of_formula("W**2") == "no formula, at character 3" + how);
  CHECK(fault_of_formula("") == "no formula, at character 1" + how);
  CHECK(fault_of_formula("(W").starts_with("no formula, at character "));
  CHECK(fault_of_formula("W > 2 ? 1 :").starts_with("no formula, at character "));
  CHECK(fault_of_formula("e*W") == "unknown name \"e\" in the formula");
  CHECK(fault_of_formula("1,5*W") ==
        "a formula has one value; write decimals with a point, not a comma");
  const std::string one =
      "a formula has either W, the gap between walls, or D, the diameter of a "
      "tube";
  CHECK(fault_of_formula("0.4") == one);
  CHECK(fault_of_formula("W + D") == one);
}

}  // namespace
}  // namespace grainsweep
