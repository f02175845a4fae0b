#include "runner/compare/formula.hpp"

#include <algorithm>
#include <cctype>
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

}  // namespace

std::string fault_of_formula(const std::string& formula) {
  const char* const known =
      "known are W, the gap between walls, or D, the diameter of a tube; d, pi; and functions in "
      "small letters with brackets, as exp(-D)";
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
  double extent = 1.0;
  try {
    const mu::Parser parser = parser_of(formula, extent);
    const mu::varmap_type& names = parser.GetUsedVar();
    for (const auto& [name, place] : names) {
      const bool is_number = std::isdigit(static_cast<unsigned char>(name.front())) != 0;
      if (is_number) return "the number " + name + " is too large";
      if (name != "W" && name != "D") return "unknown name \"" + name + "\"; " + known;
    }
    if (names.size() != 1) {
      return "a formula has either W, the gap between walls, or D, the diameter of a tube; what "
             "does "
             "not depend on them is a \"value\" at a \"width\"";
    }
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
  double extent = 1.0;
  return parser_of(formula, extent).GetUsedVar().begin()->first;
}

double value_of_formula(const std::string& formula, double extent) {
  return parser_of(formula, extent).Eval();
}

}  // namespace grainsweep
