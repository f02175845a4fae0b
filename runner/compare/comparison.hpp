// What the reference study of confined packings says (Camenen, Descantes, Richard, Powders &
// Grains 2013), and what a sweep found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/tables/fits.hpp"

namespace grainsweep {

/// A value of the paper: a number, a range, or nothing but words.
struct PaperValue {
  std::string text;  ///< as printed: "6.027 ± 0.012", "3 to 4", "not printed"
  /// The range in numbers, low = high for a single one; nothing where there is none.
  struct Range {
    double low = 0.0, high = 0.0;
    double error = 0.0;  ///< printed error, 0 if there is none
  };
  std::optional<Range> range;
};

struct Comparison {
  std::string family;
  std::string quantity;  ///< "λ_L / d_avg at W = 10 d"
  PaperValue paper;
  Estimate ours;               ///< value and standard error
  std::string not_determined;  ///< why there is no value of ours; empty if there is one
  std::string definition;      ///< of our value
};

/// Ours less the paper's, from the nearer end of a range and 0 inside it; nothing if either is
/// missing.
std::optional<double> difference(const Comparison& comparison);

/// The same over the standard errors of both, added in quadrature.
std::optional<double> difference_in_errors(const Comparison& comparison);

/// Every number of the paper, family by family, and what has been measured beside it.
std::vector<Comparison> compare_with_paper(const std::vector<Family>& families);

/// A table for people: UTF-8, the definition of our value below each row.
std::string comparison_text(const std::vector<Comparison>& comparisons);

}  // namespace grainsweep
