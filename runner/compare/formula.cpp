#include "runner/compare/formula.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <muParser.h>
#include <numbers>
#include <set>
#include <string>

#include "engine/text.hpp"

namespace grainsweep {
namespace {

/// What a formula depends on, d.
struct Place {
  double extent = 1.0;    ///< W or D
  double distance = 0.5;  ///< y
};

/// Of order 0, an even function.
double bessel(double x) { return std::cyl_bessel_j(0.0, std::abs(x)); }

/// A parser of a formula at `place`, which must outlive it. Throws mu::ParserError.
mu::Parser parser_of(const std::string& formula, Place& place) {
  mu::Parser parser;
  parser.DefineFun("J0", bessel);
  parser.DefineConst("d", 1.0);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineVar("W", &place.extent);
  parser.DefineVar("D", &place.extent);
  parser.DefineVar("y", &place.distance);
  parser.SetExpr(formula);
  return parser;
}

/// Whether a = stands in it that is no part of a comparison.
bool has_assignment(const std::string& formula) {
  for (std::size_t k = 0; k < formula.size(); ++k) {
    if (formula[k] != '=') continue;
    const char before = k > 0 ? formula[k - 1] : ' ';
    const bool is_double = k + 1 < formula.size() && formula[k + 1] == '=';
    const bool is_comparison =
        is_double || before == '=' || before == '<' || before == '>' || before == '!';
    if (!is_comparison) return true;
  }
  return false;
}

/// Why a formula may not have just these; "" if it may.
std::string fault_of_names(const std::set<std::string>& names, FormulaOf of) {
  const bool has_both = names.contains("W") && names.contains("D");
  if (of == FormulaOf::distance) {
    if (!names.contains("y")) return "a profile has y, the distance from the wall";
    return has_both ? "a profile has either W, the gap between walls, or D, the diameter of a tube"
                    : "";
  }
  return !has_both && !names.empty()
             ? ""
             : "a formula has either W, the gap between walls, or D, the diameter of a tube; what "
               "does not depend on them is a \"value\" at a \"width\"";
}

}  // namespace

std::string fault_of_formula(const std::string& formula, FormulaOf of) {
  const bool has_distance = of == FormulaOf::distance;
  const std::string known =
      std::string("known are ") + (has_distance ? "y, the distance from the wall; " : "") +
      "W, the gap between walls, or D, the diameter of a tube; d, pi; and functions in small "
      "letters with brackets, as exp(-D)";
  if (formula.find_first_not_of(" \t") == std::string::npos) return "is empty";
  constexpr std::size_t longest = 5000;
  if (formula.size() > longest) return joined("is longer than ", longest, " characters");
  if (std::any_of(formula.begin(), formula.end(), [](char c) { return c < ' ' || c > '~'; })) {
    return "has characters that are no plain ones, as texts copied from a page do; write - * ^2";
  }
  if (formula.find("log(") != std::string::npos || formula.find("log (") != std::string::npos) {
    return "log is the natural logarithm to some, to others that of base 10; write ln or log10";
  }
  if (has_assignment(formula)) {
    return "a formula is what stands to the right of =; leave the rest out";
  }
  Place place;
  try {
    const mu::Parser parser = parser_of(formula, place);
    std::set<std::string> names;
    for (const auto& [name, value] : parser.GetUsedVar()) {
      const bool is_number = std::isdigit(static_cast<unsigned char>(name.front())) != 0;
      if (is_number) return "the number " + name + " is too large";
      const bool is_known = name == "W" || name == "D" || (has_distance && name == "y");
      if (!is_known) return "unknown name \"" + name + "\"; " + known;
      names.insert(name);
    }
    std::string fault = fault_of_names(names, of);
    if (!fault.empty()) return fault;
    parser.Eval();
    if (parser.GetNumResults() == 1) return "";
    return "a formula has one value; write decimals with a point, not a comma";
  } catch (const mu::ParserError& error) {
    const auto size = static_cast<int>(formula.size());
    if (error.GetPos() >= size)
      return "ends too early: a bracket is not closed, or a number missing";
    return joined(
        "not understood at character ", std::max(error.GetPos(), 0) + 1,
        "; write products with *, powers with ^, decimals with a point, and lengths in d: "
        "0.4 + 0.05*d/D + 0.412*(d/D)^2; ",
        known);
  }
}

std::string symbol_of_formula(const std::string& formula) {
  Place place;
  return parser_of(formula, place).GetUsedVar().begin()->first;
}

double value_of_formula(const std::string& formula, double extent, double distance) {
  Place place{extent, distance};
  return parser_of(formula, place).Eval();
}

}  // namespace grainsweep
