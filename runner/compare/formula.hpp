// Formulas over the distance between walls, as sources print them, "0.4 + 0.05*d/D +
// 0.412*(d/D)^2", and over the distance from a wall, "0.38 + 0.62*J0(6.64*y)*exp(-0.22*y)".
#pragma once

#include <string>

namespace grainsweep {

/// What a formula is over.
enum class FormulaOf {
  width,     ///< W, the gap between walls, or D, the diameter of a tube, of which it must have one
  distance,  ///< y, the distance from the nearest wall, which it must have; it may have W or D, too
};

/// What is wrong with a formula, or "". Known are these; d, the diameter of a grain; pi; + - * / ^
/// and brackets; and exp, ln, log10, sqrt, abs, sin, cos, tan, min, max, what else muParser has,
/// and J0, the Bessel function.
std::string fault_of_formula(const std::string& formula, FormulaOf of = FormulaOf::width);

/// "W" or "D", whichever it is a formula over. It must be without fault, here and below.
std::string symbol_of_formula(const std::string& formula);

/// Its value where the gap or the diameter is `extent`, at a distance from the wall, both d; may be
/// infinite or NaN.
double value_of_formula(const std::string& formula, double extent, double distance = 0.0);

}  // namespace grainsweep
