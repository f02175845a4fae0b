#include <string>

#include "runner/sweep/identity.hpp"
#include "runner/sweep/parameter_row.hpp"

namespace grainsweep {
namespace {

template <auto member>
Parameter of_classes(const char* path, const Interval& range, const char* meaning) {
  return own(path, range, meaning, ValueKind::number, Role::size_class,
             set_member<&ResolvedSpec::spec, &PackingSpec::sizes, member>,
             [](const ResolvedSpec& resolved) {
               if (resolved.spec.sizes.distribution) return std::optional<Value>();
               return get_member<&ResolvedSpec::spec, &PackingSpec::sizes, member>(resolved);
             });
}

template <auto member>
Parameter share_of_classes(const char* path, const Interval& range, const char* meaning) {
  Parameter parameter = of_classes<member>(path, range, meaning);
  parameter.is_share = true;
  return parameter;
}

/// The distribution that is being written; a new one if there is none yet.
SizeDistribution& distribution_of(ResolvedSpec& resolved) {
  auto& distribution = resolved.spec.sizes.distribution;
  return distribution ? *distribution : distribution.emplace();
}

/// The formula of the distribution that is being written, which becomes one of this kind.
template <class Formula>
Formula& formula_of(ResolvedSpec& resolved) {
  SizeFormula& formula = distribution_of(resolved).formula;
  resolved.has_size_formula = true;
  auto* same = std::get_if<Formula>(&formula);
  return same != nullptr ? *same : formula.emplace<Formula>();
}

template <class Formula>
const Formula* formula_of(const ResolvedSpec& resolved) {
  const auto& distribution = resolved.spec.sizes.distribution;
  return distribution ? std::get_if<Formula>(&distribution->formula) : nullptr;
}

/// A number of a formula, written in the unit of the distribution and kept in it until all is
/// known.
template <class Formula, double Formula::*member>
Parameter of_formula(const char* path, const Interval& range, const char* meaning) {
  return own(
      path, range, meaning, ValueKind::number, Role::size_formula,
      [](ResolvedSpec& resolved, const Value& value) {
        formula_of<Formula>(resolved).*member = std::get<double>(value);
      },
      [](const ResolvedSpec& resolved) {
        const auto* formula = formula_of<Formula>(resolved);
        return formula != nullptr ? present(formula->*member) : std::nullopt;
      });
}

template <class Formula, double Formula::*member>
Parameter diameter_of_formula(const char* path, const char* meaning) {
  Parameter parameter = in("d", of_formula<Formula, member>(path, positive, meaning));
  parameter.is_diameter = true;
  return parameter;
}

template <std::vector<double> SizeTable::*member>
Parameter of_table(const char* path, const Interval& range, const char* meaning) {
  Parameter parameter = own(
      path, range, meaning, ValueKind::numbers, Role::size_table,
      [](ResolvedSpec& resolved, const Value& value) {
        formula_of<SizeTable>(resolved).*member = std::get<std::vector<double>>(value);
      },
      [](const ResolvedSpec& resolved) {
        const auto* table = formula_of<SizeTable>(resolved);
        const bool is_written = resolved.size_file.empty() && table != nullptr;
        return is_written && !(table->*member).empty() ? present(table->*member) : std::nullopt;
      });
  parameter.most_items = most_size_rows;
  parameter.is_diameter = member == &SizeTable::diameters;
  if (parameter.is_diameter) parameter.unit = "d";
  parameter.are_distinct = parameter.is_diameter;
  return parameter;
}

Parameter table_file() {
  Parameter parameter = own(
      "sizes.distribution.table.file", WrittenValues{},
      "CSV file of diameter and passing, retained or share, instead; relative to the sweep "
      "file",
      ValueKind::text, Role::size_file,
      [](ResolvedSpec& resolved, const Value& value) {
        formula_of<SizeTable>(resolved) = {};
        resolved.size_file = std::get<std::string>(value);
      },
      [](const ResolvedSpec& resolved) {
        const auto* table = formula_of<SizeTable>(resolved);
        const bool is_read = !resolved.size_file.empty() && table != nullptr;
        return is_read ? present(hash_of(*table)) : std::nullopt;
      });
  parameter.is_diameter = true;
  return parameter;
}

/// Where the curve is cut.
template <std::optional<double> SizeDistribution::*member>
Parameter cut_at(const char* path, const char* meaning) {
  return in("d", own(
                     path, positive, meaning, ValueKind::number, Role::distribution,
                     [](ResolvedSpec& resolved, const Value& value) {
                       distribution_of(resolved).*member = std::get<double>(value);
                     },
                     [](const ResolvedSpec& resolved) {
                       const auto& distribution = resolved.spec.sizes.distribution;
                       const bool is_cut = distribution && (*distribution).*member;
                       return is_cut ? present(*((*distribution).*member)) : std::nullopt;
                     }));
}

Parameter weight() {
  return own(
      "sizes.distribution.by",
      Names{{"number", "of the grains, each counted once"},
            {"area", "of their surface"},
            {"volume", "of their volume, and so of their mass"}},
      "what the shares of the distribution are shares of", ValueKind::choice, Role::distribution,
      [](ResolvedSpec& resolved, const Value& value) {
        distribution_of(resolved).by = static_cast<SizeWeight>(std::get<std::int64_t>(value));
      },
      [](const ResolvedSpec& resolved) {
        const auto& distribution = resolved.spec.sizes.distribution;
        return distribution ? present(static_cast<std::int64_t>(distribution->by)) : std::nullopt;
      });
}

std::vector<Parameter> formula_parameters() {
  using L = LognormalSizes;
  using U = UniformSizes;
  using W = WeibullSizes;
  return {
      diameter_of_formula<L, &L::median>("sizes.distribution.lognormal.median",
                                         "diameter that half of the grains are finer than, d"),
      of_formula<L, &L::sigma>("sizes.distribution.lognormal.sigma", Interval{0, 2},
                               "standard deviation of the logarithm of the diameter"),
      diameter_of_formula<U, &U::from>("sizes.distribution.uniform.from", "least diameter, d"),
      diameter_of_formula<U, &U::to>("sizes.distribution.uniform.to", "largest diameter, d"),
      diameter_of_formula<W, &W::scale>("sizes.distribution.weibull.scale",
                                        "diameter that the share 1 - 1/e is finer than, d"),
      of_formula<W, &W::shape>("sizes.distribution.weibull.shape", Interval{0.1, 100},
                               "exponent k: the share 1 - exp(-(D / scale)^k) is finer than D"),
  };
}

/// The lengths of a formula.
struct Lengths {
  std::vector<double*> operator()(LognormalSizes& sizes) const { return {&sizes.median}; }
  std::vector<double*> operator()(UniformSizes& sizes) const { return {&sizes.from, &sizes.to}; }
  std::vector<double*> operator()(WeibullSizes& sizes) const { return {&sizes.scale}; }
  std::vector<double*> operator()(SizeTable& table) const {
    std::vector<double*> diameters;
    for (double& diameter : table.diameters) diameters.push_back(&diameter);
    return diameters;
  }
};

}  // namespace

void to_units_of(double size, SizeDistribution& distribution) {
  std::vector<double*> lengths = std::visit(Lengths(), distribution.formula);
  for (auto* end : {&distribution.smallest, &distribution.largest}) {
    if (*end) lengths.push_back(&**end);
  }
  for (double* length : lengths) *length /= size;
  distribution.size = size;
}

std::vector<Parameter> size_parameters() {
  std::vector<Parameter> all = {
      share_of_classes<&SizesSpec::spread>(
          "sizes.spread", {0, 0.2}, "standard deviation of the diameter over its mean, each class"),
      share_of_classes<&SizesSpec::small_share>(
          "sizes.small_share", {0, 1}, "share of the small class in the solid volume, 0 to 1"),
      in("d", of_classes<&SizesSpec::size_ratio>("sizes.size_ratio", {0.02, 1, true},
                                                 "mean diameter of the small class, d")),
  };
  for (Parameter& parameter : formula_parameters()) all.push_back(std::move(parameter));
  for (Parameter& parameter : std::vector<Parameter>{
           of_table<&SizeTable::diameters>("sizes.distribution.table.diameters", positive,
                                           "diameters of a sieve curve, ascending, d"),
           of_table<&SizeTable::passing>(
               "sizes.distribution.table.passing", Interval{0, 1},
               "share finer than each of them, from 0 to 1, linear between two"),
           of_table<&SizeTable::shares>("sizes.distribution.table.shares", Interval{0, 1},
                                        "instead: share of the grains of just each diameter"),
           table_file(), weight(),
           cut_at<&SizeDistribution::smallest>("sizes.distribution.smallest",
                                               "where the curve is cut below, d; if left out, of "
                                               "lognormal and weibull where 0.1 % are finer"),
           cut_at<&SizeDistribution::largest>(
               "sizes.distribution.largest",
               "where it is cut above, d; if left out, of those two where 0.1 % are coarser"),
           own("sizes.distribution.size", positive,
               "the length that is d in the unit in which the lengths of the distribution are "
               "written; 1 if left out. Tables have them in d",
               ValueKind::number, Role::distribution, set_member<&ResolvedSpec::size_unit>,
               no_identity)}) {
    all.push_back(std::move(parameter));
  }
  return all;
}

}  // namespace grainsweep
