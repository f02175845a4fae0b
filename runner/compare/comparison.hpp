// What a source says of a sweep's packings, what the sweep found, and whether both agree.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/compare/quantities.hpp"
#include "runner/compare/reference.hpp"

namespace grainsweep {

/// So many standard errors, of both sides in quadrature, may lie between values that agree, besides
/// the bound of the bias of settling.
inline constexpr double agreement_limit = 3.0;

/// Whether a measured and a published value agree: within the errors of both, or, besides, within
/// the bound of what settling does to the measured one.
enum class Agreement { unknown, agrees, within_bound, differs };

struct Comparison {
  std::string family;
  std::string title;  ///< "Z at W = 10 d"
  Published published;
  Measured measured = {};
  std::optional<Misfit> misfit = {};  ///< of families, for a value that is said to hold for all
  /// Of a formula: each width of the family where it holds and both values are known, with the
  /// formula's value there. Of a profile: each of its points where the measured value is known.
  std::vector<Comparison> along = {};
  std::size_t without_value = 0;  ///< how many more there are where one of them is not
  double distance = 0.0;          ///< of such a point from the wall, d
  std::size_t group = 0;          ///< the number of the group that a profile is of; else 0
};

/// Measured minus published value, from the nearer end of a range and 0 inside it; nothing if
/// either is missing.
std::optional<double> difference(const Comparison& comparison);

/// The same divided by the standard errors of both, added in quadrature.
std::optional<double> difference_in_errors(const Comparison& comparison);

/// The same divided by the published value; nothing for a range, and for 0.
std::optional<double> relative_difference(const Comparison& comparison);

/// Unknown where one side is missing or has no error.
Agreement agreement_of(const Comparison& comparison);

/// "agrees: -0.013, 0.8 errors"; "differs: ..."; of a formula "agrees at 3 of 9 widths; ...", of a
/// profile "agrees at 30 of 40 points; ..."; "-" if there is nothing to compare.
std::string verdict(const Comparison& comparison);

/// What `along` of a row lists: "width" of a formula, "point" of a profile.
std::string name_of_each(const Published& published);

/// What the source has for each family, then what it says of all. Families for which it has
/// nothing, and published families that are not in the sweep, are named by comparison_text.
std::vector<Comparison> compare_with(const Reference& reference, const Analysis& analysis);

/// A table for people: UTF-8, the definitions of both values below each row. Names the families
/// without published values.
std::string comparison_text(const Reference& reference, const Analysis& analysis);

}  // namespace grainsweep
