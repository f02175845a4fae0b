#include "runner/sweep/size_formulas.hpp"

#include <algorithm>

namespace grainsweep {

const std::array<SizeFormulaKind, std::variant_size_v<SizeFormula>>& size_formula_kinds() {
  static const std::array<SizeFormulaKind, std::variant_size_v<SizeFormula>> kinds = {{
      {"lognormal", "the logarithm of the diameter is Gaussian", false, LognormalSizes{}},
      {"uniform", "as likely everywhere between two diameters", true, UniformSizes{}},
      {"weibull", "by volume Rosin-Rammler's curve of ground matter", false, WeibullSizes{}},
      {"table", "a sieve curve, or the shares of single diameters", true, std::nullopt},
  }};
  return kinds;
}

const SizeFormulaKind* size_formula_kind_of(std::string_view path) {
  constexpr std::string_view home = "sizes.distribution.";
  if (!path.starts_with(home)) return nullptr;
  path.remove_prefix(home.size());
  const std::string_view name = path.substr(0, path.find('.'));
  const auto& kinds = size_formula_kinds();
  const auto* const found = std::find_if(
      kinds.begin(), kinds.end(), [&](const SizeFormulaKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : found;
}

std::string size_formula_names(std::string_view between, std::string_view before_last) {
  const auto& kinds = size_formula_kinds();
  std::string names;
  for (const SizeFormulaKind& kind : kinds) {
    if (!names.empty()) names += &kind == &kinds.back() ? before_last : between;
    names += kind.name;
  }
  return names;
}

}  // namespace grainsweep
