#include <catch2/catch.hpp>

#include "runner/sweep/parameters.hpp"
#include "runner/sweep/size_formulas.hpp"

namespace grainsweep {
namespace {

TEST_CASE("kinds of distributions stand in the order of their formulas") {
  const auto& kinds = size_formula_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    INFO(kinds[k].name);
    if (kinds[k].usual) CHECK(kinds[k].usual->index() == k);
    CHECK(is_group("sizes.distribution." + std::string(kinds[k].name)));
    CHECK(meaning_of_group("sizes.distribution." + std::string(kinds[k].name)) == kinds[k].meaning);
  }
  CHECK(size_formula_names() == "lognormal, uniform, weibull, table");
  CHECK(size_formula_names("|", " or ") == "lognormal|uniform|weibull or table");
}

TEST_CASE("curves end by themselves where their kind says so") {
  for (const SizeFormulaKind& kind : size_formula_kinds()) {
    if (!kind.usual) continue;
    INFO(kind.name);
    const std::vector<double> whole = curve_of({*kind.usual}).diameters;
    const SizeCurve wider = curve_of({*kind.usual, SizeWeight::volume, whole.front() / 2});
    CHECK((wider.diameters.front() == whole.front()) == kind.has_ends);
  }
}

TEST_CASE("a path belongs to a kind by its group") {
  CHECK(size_formula_kind_of("sizes.distribution.weibull")->name == "weibull");
  CHECK(size_formula_kind_of("sizes.distribution.weibull.scale")->name == "weibull");
  CHECK(size_formula_kind_of("sizes.distribution.table.file")->name == "table");
  for (const char* other : {"sizes.distribution", "sizes.distribution.by", "sizes.spread",
                            "sizes.distribution.wei", "sizes.distribution.", ""}) {
    INFO(other);
    CHECK(size_formula_kind_of(other) == nullptr);
  }
}

}  // namespace
}  // namespace grainsweep
