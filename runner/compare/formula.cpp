#include "runner/compare/formula.hpp"

#include <algorithm>
#include <muParser.h>
#include <numbers>

#include "engine/text.hpp"

namespace grainsweep {
namespace {

/// A parser of a formula whose extent is that of `extent`, which must outlive it. Throws
/// mu::ParserError.
mu::Parser parser_of(const std::string& formula, double& extent) {
  mu::Parser parser;
  parser.DefineConst("d", 1.0);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineVar("W", &extent);
  parser.DefineVar("D", &extent);
  parser.SetExpr(formula);
  return parser;
}

}  // namespace

std::string fault_of_formula(const std::string& formula) {
  double extent = 1.0;
  try {
    const mu::Parser parser = parser_of(formula, extent);
    const mu::varmap_type& names = parser.GetUsedVar();
    for (const auto& [name, place] : names) {
      if (name != "W" && name != "D") return "unknown name \"" + name + "\" in the formula";
    }
    if (names.size() != 1) {
      return "a formula has either W, the gap between walls, or D, the diameter of a tube";
    }
    parser.Eval();
    if (parser.GetNumResults() == 1) return "";
    return "a formula has one value; write decimals with a point, not a comma";
  } catch (const mu::ParserError& error) {
    return joined("no formula, at character ", std::max(error.GetPos(), 0) + 1,
                  "; write products with *, powers with ^: 0.4 + 0.05*d/D + 0.412*(d/D)^2");
  }
}

std::string symbol_of_formula(const std::string& formula) {
  double extent = 1.0;
  return parser_of(formula, extent).GetUsedVar().begin()->first;
}

double value_of_formula(const std::string& formula, double extent) {
  return parser_of(formula, extent).Eval();
}

}  // namespace grainsweep
