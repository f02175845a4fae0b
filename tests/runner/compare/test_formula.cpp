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

TEST_CASE("a profile is a formula over the distance from the wall") {
  const std::string mueller =
      "0.365 + 0.22*d/D + (0.635 - 0.22*d/D)*J0((7.45 - 3.15*d/D)*y)*exp(-(0.315 - 0.725*d/D)*y)";
  CHECK(fault_of_formula(mueller, FormulaOf::distance).empty());
  CHECK(value_of_formula(mueller, 8.0, 0.0) == Approx(1.0).epsilon(1e-12));
  // J0(2.404825557695773) = 0
  CHECK(value_of_formula("J0(2.404825557695773*y)", 8.0, 1.0) == Approx(0.0).margin(1e-14));
  CHECK(value_of_formula("J0(-y)", 8.0, 1.0) == value_of_formula("J0(y)", 8.0, 1.0));
  CHECK_THAT(fault_of_formula(mueller), Catch::StartsWith("unknown name \"y\""));
}

TEST_CASE("a formula may have no number somewhere") {
  const std::string file = "1 - 2/3/D^3/sqrt(2/D - 1)";
  CHECK(fault_of_formula(file).empty());
  CHECK(value_of_formula(file, 1.0) == Approx(1.0 / 3.0).epsilon(1e-12));
  CHECK_FALSE(std::isfinite(value_of_formula(file, 2.0)));
  CHECK_FALSE(std::isfinite(value_of_formula(file, 3.0)));
}

TEST_CASE("of a formula that cannot be read it is told where, and how to write one") {
  const auto at = [](int character) {
    return "not understood at character " + std::to_string(character) + "; write products with *";
  };
  CHECK(fault_of_formula("0.4 + 0.05 d/D").starts_with(at(12)));
  CHECK(fault_of_formula("W**2").starts_with(at(3)));
  CHECK(fault_of_formula("37.5% - W").starts_with(at(5)));
  CHECK(fault_of_formula("EXP(-W)").starts_with(at(4)));
  CHECK(fault_of_formula("") == "is empty");
  CHECK(fault_of_formula(" ") == "is empty");
  for (const char* cut : {"(W", "0.4 + W *", "exp(-W"}) {
    INFO(cut);
    CHECK(fault_of_formula(cut) == "ends too early: a bracket is not closed, or a number missing");
  }
  CHECK_THAT(fault_of_formula("e*W"),
             Catch::StartsWith("unknown name \"e\"; known are W, the gap"));
  CHECK(fault_of_formula("W*1e999") == "the number 1e999 is too large");
  CHECK(fault_of_formula("W" + std::string(5000, '+') + "1") == "is longer than 5000 characters");
  CHECK_THAT(fault_of_formula("0.4 + x"), Catch::StartsWith("unknown name \"x\"; known are W"));
  CHECK(fault_of_formula("1,5*W") ==
        "a formula has one value; write decimals with a point, not a comma");
  for (const char* neither : {"0.4", "W + D", "1 - pi/6"}) {
    CHECK_THAT(fault_of_formula(neither), Catch::StartsWith("a formula has either W, the gap"));
  }
  CHECK(fault_of_formula("D=3") ==
        "a formula is what stands to the right of =; leave the rest out");
  CHECK_THAT(fault_of_formula("0.1*log(D)"), Catch::EndsWith("write ln or log10"));
  CHECK(fault_of_formula("0.1*log10(D)").empty());
  CHECK_THAT(fault_of_formula("W\u00b2"),
             Catch::StartsWith("has characters that are no plain ones"));
  CHECK_THAT(fault_of_formula("W\n+1"), Catch::StartsWith("has characters that are no plain ones"));
}

}  // namespace
}  // namespace grainsweep
