#include "runner/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/text.hpp"
#include "runner/compare/formula.hpp"
#include "runner/tables/fits.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Two significant digits of the error.
int decimals_for(double error) {
  if (!(error > 0.0) || !std::isfinite(error)) return 3;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6);
}

/// The values that the source has for `family`, from all its entries that describe it.
std::vector<Published> published_of(const Reference& reference, const Family& family) {
  std::vector<Published> values;
  for (const PublishedFamily& entry : reference.families) {
    if (!describes(entry.where, family)) continue;
    values.insert(values.end(), entry.values.begin(), entry.values.end());
  }
  return values;
}

std::string signed_text(double difference) {
  constexpr double unit = 1e-4;
  const double rounded = std::round(difference / unit) * unit + 0.0;  // no -0
  return (rounded > 0.0 ? "+" : "") + fixed(rounded, 4);
}

/// "0.8"; with more decimals where values that differ would seem to lie at the limit: "3.04".
std::string errors_text(double errors) {
  constexpr int most_decimals = 6;
  std::string text = fixed(errors, 1);
  for (int decimals = 2; decimals <= most_decimals && errors > agreement_limit; ++decimals) {
    if (std::stod(text) > agreement_limit) break;
    text = fixed(errors, decimals);
  }
  return text;
}

/// Where a value of a row stands along it: "W = 5 d", "0.5 d from the wall".
std::string place_of(const Comparison& at, const Published& published) {
  return published.formula
             ? symbol_of_formula(published.formula->text) + " = " + cell(at.published.width) + " d"
             : cell(at.distance) + " d from the wall";
}

/// How many widths agree with a formula, or points with a profile, and how far they lie from it.
std::string along_text(const Comparison& row) {
  const std::vector<Comparison>& along = row.along;
  const auto with = [&](Agreement agreement) {
    return static_cast<std::size_t>(
        std::count_if(along.begin(), along.end(),
                      [&](const Comparison& at) { return agreement_of(at) == agreement; }));
  };
  const std::size_t unknown = with(Agreement::unknown), by_bound = with(Agreement::within_bound);
  const std::size_t known = along.size() - unknown;
  const auto is_less = [](const Comparison& a, const Comparison& b) {
    return *difference(a) < *difference(b);
  };
  const auto [least, most] = std::minmax_element(along.begin(), along.end(), is_less);
  double mean = 0.0, mean_square = 0.0;
  for (const Comparison& at : along) {
    mean += *difference(at) / static_cast<double>(along.size());
    mean_square += std::pow(*difference(at), 2) / static_cast<double>(along.size());
  }
  const std::string one_of_them = name_of_each(row.published);
  std::string text = known == 0 ? "no error is known at any " + one_of_them
                                : joined("agrees at ", with(Agreement::agrees) + by_bound, " of ",
                                         counted(known, one_of_them));
  if (by_bound > 0) text += joined(", at ", by_bound, " of them within the bound of settling");
  if (known > 0 && unknown > 0) text += joined(", no error at ", unknown, " more");
  if (row.without_value > 0) text += joined(", no value at ", row.without_value, " more");
  text += "; here minus published: ";
  const auto at = [&](const Comparison& one) {
    return signed_text(*difference(one)) + " at " + place_of(one, row.published);
  };
  if (along.size() == 1) return text + at(*least);
  return text + signed_text(mean) + " in the mean, " +
         (row.published.profile ? fixed(std::sqrt(mean_square), 4) + " root mean square, " : "") +
         at(*least) + " to " + at(*most);
}

std::string row_text(const Comparison& row) {
  const int decimals = decimals_for(row.measured.estimate.error);
  const auto number = [&](double value) { return fixed(value, decimals); };
  const std::string start =
      "  " + pad_right(row.title, 38) + pad_left(row.published.text, 19) + "  ";
  const std::string source_definition =
      row.published.definition.empty() ? "" : "      published: " + row.published.definition + "\n";
  if (!row.measured.not_determined.empty()) {
    return start + "not determined: " + row.measured.not_determined + "\n" + source_definition;
  }
  return start +
         pad_left(number(row.measured.estimate.value) + " ± " + number(row.measured.estimate.error),
                  19) +
         "  " + verdict(row) + "\n" + source_definition + "      here: " + row.measured.definition +
         "\n";
}

/// The row of a formula or a profile.
std::string curve_text(const Comparison& row) {
  const std::string& source = row.published.definition;
  return "  " + pad_right(row.title, 38) + " " + row.published.text + "\n      " +
         (row.along.empty() ? "not determined: " + row.measured.not_determined : verdict(row)) +
         "\n" + (source.empty() ? "" : "      published: " + source + "\n") +
         (row.along.empty() ? ""
                            : "      here, at " + place_of(row.along.back(), row.published) + ": " +
                                  row.measured.definition + "\n");
}

std::string head_of(const std::string& family) {
  return "\n" + family + "\n  " + pad_right("", 38) + pad_left("published", 19) + "  " +
         pad_left("here ± std. error", 19) + "  difference\n";
}

/// Families of the sweep without published values, and published ones that are not in the sweep.
std::string left_out_text(const Reference& reference, const std::vector<Family>& families) {
  std::string text;
  for (const Family& family : families) {
    const bool has_some = !published_of(reference, family).empty() || !reference.common.empty();
    if (!has_some) text += "  " + family.name + "\n";
  }
  if (!text.empty()) text = "\nNothing is published there of\n" + text;
  for (const PublishedFamily& entry : reference.families) {
    const bool is_here = std::any_of(families.begin(), families.end(), [&](const Family& family) {
      return describes(entry.where, family);
    });
    if (is_here) continue;
    text += "\nNot in the sweep:";
    for (const auto& [path, value] : entry.where) text.append(" ").append(path + "=" + value);
    text += "\n";
    for (const auto& [path, value] : entry.where) {
      const std::string advice = advice_on(path);
      const std::string values = values_in(families, path);
      if (!advice.empty()) {
        text.append("  ").append(advice + "\n");
      } else if (!values.empty()) {
        text.append("  the sweep has " + path + " ").append(values + "\n");
      }
    }
  }
  return text;
}

}  // namespace

std::string name_of_each(const Published& published) {
  return published.profile ? "point" : "width";
}

std::optional<double> difference(const Comparison& comparison) {
  const auto& range = comparison.published.range;
  if (!range || !comparison.measured.not_determined.empty()) return std::nullopt;
  const double value = comparison.measured.estimate.value;
  return value - std::clamp(value, range->low, range->high);
}

std::optional<double> difference_in_errors(const Comparison& comparison) {
  const auto miss = difference(comparison);
  if (!miss) return std::nullopt;
  return *miss / std::hypot(comparison.measured.estimate.error, comparison.published.range->error);
}

std::optional<double> relative_difference(const Comparison& comparison) {
  const auto miss = difference(comparison);
  if (!miss) return std::nullopt;
  const Published::Range& range = *comparison.published.range;
  return range.low == range.high && range.low != 0.0 ? std::optional(*miss / range.low)
                                                     : std::nullopt;
}

Agreement agreement_of(const Comparison& comparison) {
  const auto miss = difference(comparison);
  if (!miss) return Agreement::unknown;
  const double error =
      std::hypot(comparison.measured.estimate.error, comparison.published.range->error);
  if (!std::isfinite(error)) return Agreement::unknown;
  const double beyond = std::abs(*miss) - agreement_limit * error;
  return beyond <= 0.0                              ? Agreement::agrees
         : beyond <= comparison.measured.bias_bound ? Agreement::within_bound
                                                    : Agreement::differs;
}

std::string verdict(const Comparison& comparison) {
  if (!comparison.along.empty()) return along_text(comparison);
  std::string text;
  if (comparison.misfit && comparison.measured.not_determined.empty()) {
    text = may_hold(*comparison.misfit) ? "one value for all" : "not one value for all";
  }
  const auto miss = difference(comparison), errors = difference_in_errors(comparison);
  const Agreement agreement = agreement_of(comparison);
  if (agreement == Agreement::unknown || !std::isfinite(*errors)) return text.empty() ? "-" : text;
  const std::string sign = *miss > 0.0 ? "+" : "";
  const bool is_by_bound = agreement == Agreement::within_bound;
  return text + (text.empty() ? "" : "; ") +
         (agreement == Agreement::differs ? "differs" : "agrees") +
         (is_by_bound ? " within the bound of settling, " + cell(comparison.measured.bias_bound)
                      : "") +
         ": " + sign + fixed(*miss, decimals_for(comparison.measured.estimate.error)) + ", " +
         errors_text(std::abs(*errors)) + " errors";
}

namespace {

Comparison compare_with(const Published& value, const Family& family, const std::string& folder) {
  const std::string symbol = extent_symbol(family.walled);
  return {family.name, title_of_quantity(value.quantity, value.width, symbol), value,
          measure_quantity(value.quantity, value.width, family, folder)};
}

/// Sets a measured value beside that of a formula, which is nothing where it is no number, or no
/// share of a volume although it ought to be one.
void add_width(Measured measured, double width, Comparison& row) {
  const PublishedFormula& formula = *row.published.formula;
  const double published = value_of_formula(formula.text, width);
  const bool is_mean = measured.not_determined.empty() || is_mean_of_width(row.published.quantity);
  if (!is_possible(row.published.quantity, published) || !is_mean ||
      !std::isfinite(measured.estimate.value)) {
    ++row.without_value;
    return;
  }
  row.measured = measured;
  measured.not_determined.clear();  // of a single packing, which has a value without an error
  Comparison at{row.family, row.title, row.published, std::move(measured)};
  at.published.width = width;
  at.published.range = {published, published, formula.error.of(published)};
  row.along.push_back(std::move(at));
}

/// The measured values of a family beside a formula, at every width where it holds.
Comparison compare_with_formula(const Published& value, const Family& family,
                                const std::string& folder) {
  const PublishedFormula& formula = *value.formula;
  const std::string symbol = symbol_of_formula(formula.text);
  Comparison row{family.name, title_of_quantity(value.quantity, 0.0, ""), value};
  row.measured.not_determined = "this family has no packings at a " + symbol + " where it holds";
  if (extent_symbol(family.walled) != symbol) return row;
  for (const Group& group : family.walled) {
    const double width = group.job.box.width;
    if (!(width >= formula.from && width <= formula.to)) continue;
    add_width(measure_quantity(value.quantity, family, group, folder), width, row);
  }
  if (row.along.empty() && row.without_value > 0) {
    row.measured.not_determined =
        "at no " + symbol +
        " where it holds are both the formula's value and the measured one known";
  }
  return row;
}

/// The measured profile of a family beside a published one, at its width.
Comparison compare_with_profile(const Published& value, const Family& family,
                                const std::string& folder) {
  const std::string symbol = extent_symbol(family.walled);
  Comparison row{family.name,
                 "profile of " + title_of_quantity(value.quantity, value.width, symbol), value};
  PublishedProfile& published = *row.published.profile;
  published.points = points_at(value.width, value);
  row.measured.not_determined = "the formula has no value that " + value.quantity + " can be";
  std::vector<double> distances;
  distances.reserve(published.points.size());
  for (const PublishedProfile::Point& point : published.points) {
    distances.push_back(point.distance);
  }
  const MeasuredProfile measured =
      measure_profile(value.quantity, value.width, distances, family, folder);
  row.group = measured.group == nullptr ? 0 : measured.group->number;
  Published at_point = row.published;
  at_point.profile->points.clear();  // a copy in each of them would be the square of their number
  for (std::size_t k = 0; k < distances.size(); ++k) {
    if (row.along.empty()) row.measured = measured.values[k];
    if (!measured.values[k].not_determined.empty()) {
      ++row.without_value;
      continue;
    }
    Comparison at{row.family, row.title, at_point, measured.values[k]};
    const double there = published.points[k].value;
    at.published.range = {there, there, published.error.of(there)};
    at.distance = distances[k];
    row.along.push_back(std::move(at));
  }
  return row;
}

/// The widths between walls of a family, each once.
std::set<double> widths_of(const Family& family) {
  std::set<double> widths;
  for (const Group& group : family.walled) widths.insert(group.job.box.width);
  return widths;
}

/// Appends a published value, formula or profile beside what a family has. A profile that belongs
/// to no width is set beside those of all.
void append_comparisons(const Published& value, const Family& family, const std::string& folder,
                        std::vector<Comparison>& rows) {
  if (value.formula) {
    rows.push_back(compare_with_formula(value, family, folder));
  } else if (value.profile && value.width == 0.0) {
    Published at_width = value;
    for (const double width : widths_of(family)) {
      at_width.width = width;
      rows.push_back(compare_with_profile(at_width, family, folder));
    }
  } else if (value.profile) {
    rows.push_back(compare_with_profile(value, family, folder));
  } else {
    rows.push_back(compare_with(value, family, folder));
  }
}

}  // namespace

std::vector<Comparison> compare_with(const Reference& reference, const Analysis& analysis) {
  const auto& [groups, families, folder] = analysis;
  std::vector<Comparison> rows;
  for (const Family& family : families) {
    for (const Published& value : published_of(reference, family)) {
      append_comparisons(value, family, folder, rows);
    }
  }
  for (const Published& value : reference.common) {
    const Shared shared = share_quantity(value.quantity, value.width, families, folder);
    rows.push_back({"all families",
                    title_of_quantity(value.quantity, value.width, extent_symbol(families)), value,
                    shared.measured, shared.misfit});
  }
  return rows;
}

std::string comparison_text(const Reference& reference, const Analysis& analysis) {
  std::string text, family;
  for (const Comparison& row : compare_with(reference, analysis)) {
    if (row.family != family) text += head_of(row.family);
    family = row.family;
    text += row.published.formula || row.published.profile ? curve_text(row) : row_text(row);
  }
  return text + left_out_text(reference, analysis.families);
}

}  // namespace grainsweep
