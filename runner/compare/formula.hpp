// Formulas over the distance between walls, as sources print them: "0.4 + 0.05*d/D +
// 0.412*(d/D)^2".
#pragma once

#include <string>

namespace grainsweep {

/// What is wrong with a formula, or "". Known are W, the gap between walls, or D, the diameter of a
/// tube, of which it must have one; d, the diameter of a grain; pi; + - * / ^ and brackets; and
/// exp, ln, log10, sqrt, abs, sin, cos, tan, min, max and what else muParser has.
std::string fault_of_formula(const std::string& formula);

/// "W" or "D", whichever it is a formula of. It must be without fault, here and below.
std::string symbol_of_formula(const std::string& formula);

/// Its value where the gap or the diameter is `extent`, d; may be infinite or NaN.
double value_of_formula(const std::string& formula, double extent);

}  // namespace grainsweep
