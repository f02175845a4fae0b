// The kinds of distributions of sizes: one table of what the format says of each.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "engine/scene/size_distribution.hpp"

namespace grainsweep {

struct SizeFormulaKind {
  std::string_view name;  ///< of its group in "sizes.distribution"
  std::string_view meaning;
  bool has_ends = false;             ///< whether its curve ends by itself
  std::optional<SizeFormula> usual;  ///< with its defaults; nothing if it has none
};

/// In the order of SizeFormula.
const std::array<SizeFormulaKind, std::variant_size_v<SizeFormula>>& size_formula_kinds();

/// The kind that a path is a part of, "sizes.distribution.lognormal.sigma", or the group of; null
/// if there is none.
const SizeFormulaKind* size_formula_kind_of(std::string_view path);

/// "lognormal, uniform, weibull, table", with another word between the names, and before the last.
std::string size_formula_names(std::string_view between = ", ",
                               std::string_view before_last = ", ");

}  // namespace grainsweep
