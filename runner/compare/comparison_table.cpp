#include "runner/compare/comparison_table.hpp"

#include <optional>

namespace grainsweep {
namespace {

using Line = const Comparison&;

/// The cell of what `value` gives for the published range.
template <class Value>
auto range_cell(Value value) {
  return [=](Line line) {
    return line.published.range ? cell(std::invoke(value, *line.published.range)) : std::string();
  };
}

/// The cell of a member of what was measured, where that is determined.
template <class Value>
auto measured_cell(Value value) {
  return [=](Line line) {
    return line.measured.not_determined.empty() ? cell(std::invoke(value, line.measured))
                                                : std::string();
  };
}

/// The cell of a number that a comparison may lack.
auto number_cell(std::optional<double> (*number)(Line)) {
  return [=](Line line) { return cell(number(line).value_or(no_number)); };
}

std::string agreement_text(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::within_bound:
      return "agrees within the bound of settling";
    case Agreement::differs:
      return "differs";
    case Agreement::unknown:
      return "";
  }
  return "";
}

Columns<Comparison> published_columns() {
  using Range = Published::Range;
  return {
      {"family", "", "as in fits.csv, or all families",
       [](Line line) { return cell(line.family); }},
      {"quantity", "", "its name in the file of published values",
       [](Line line) { return cell(line.published.quantity); }},
      {"width", "d",
       "gap between the walls, of a tube its diameter; empty for what belongs to no width",
       [](Line line) {
         const double width = line.published.width;
         return cell(width > 0.0 ? width : no_number);
       }},
      {"distance", "d", "from the nearest wall, of a point of a profile; else empty",
       [](Line line) { return cell(line.published.profile ? line.distance : no_number); }},
      {"published", "", "as printed there: a value, a formula, words, or what a profile has",
       [](Line line) { return cell(line.published.text); }},
      {"published_low", "",
       "the published value, of a formula that at this width, of a profile that at this distance; "
       "of a range its lower end",
       range_cell(&Range::low)},
      {"published_high", "", "the same, of a range its upper end", range_cell(&Range::high)},
      {"published_error", "", "standard error of it; 0 if the source has none",
       range_cell(&Range::error)},
  };
}

Columns<Comparison> measured_columns() {
  const auto value = [](const Measured& measured) { return measured.estimate.value; };
  const auto error = [](const Measured& measured) { return measured.estimate.error; };
  return {
      {"measured", "", "the value here; a length in d", measured_cell(value)},
      {"measured_error", "", "standard error of it; empty if it is not known",
       measured_cell(error)},
      {"bias_bound", "",
       "how far it lies at most from that of beds settled ever better; 0 if not "
       "measured",
       measured_cell(&Measured::bias_bound)},
      {"difference", "", "measured minus published, from the nearer end of a range and 0 inside it",
       number_cell(difference)},
      {"relative_difference", "", "difference over published; empty for a range",
       number_cell(relative_difference)},
      {"difference_in_errors", "", "difference over the errors of both, added in quadrature",
       number_cell(difference_in_errors)},
      {"agreement", "",
       "agrees, agrees within the bound of settling, differs, or empty if it is "
       "not known",
       [](Line line) { return cell(agreement_text(agreement_of(line))); }},
      {"chi2_per_dof", "",
       "of a value for all families: about 1 or less if one value holds for "
       "all",
       [](Line line) { return cell(line.misfit ? line.misfit->chi2_per_dof : no_number); }},
      {"reason", "", "why there is no measured value",
       [](Line line) { return cell(line.measured.not_determined); }},
      {"published_definition", "", "what the source says of its value",
       [](Line line) { return cell(line.published.definition); }},
      {"measured_definition", "", "how the value here is measured; empty if there is none",
       [](Line line) {
         const Measured& measured = line.measured;
         return cell(measured.not_determined.empty() ? measured.definition : std::string());
       }},
  };
}

Columns<Comparison> columns_of(const GivenUnits& units) {
  Columns<Comparison> columns = published_columns();
  append(columns, measured_columns());
  append_in_units(columns, units);
  return columns;
}

}  // namespace

std::string comparison_csv(const std::vector<Comparison>& comparisons, const GivenUnits& units) {
  const Columns<Comparison> columns = columns_of(units);
  std::string text = header_line(columns);
  for (const Comparison& one : comparisons) {
    if (one.along.empty()) text += row_line(columns, one);
    for (const Comparison& at : one.along) text += row_line(columns, at);
  }
  return text;
}

std::vector<ColumnText> comparison_columns(const GivenUnits& units) {
  return described("comparison.csv", columns_of(units));
}

}  // namespace grainsweep
