#include "runner/tables/distributions.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>

namespace grainsweep {
namespace {

constexpr std::string_view pair_correlation = "pair_correlation";

struct PointLine {
  const Group& group;
  std::string_view curve;
  CurvePoint point;
};

/// Where bins of the pair correlation begin and end, in the unit of the sweep: forces have none.
void append_distances(Columns<PointLine>& columns, const GivenUnits& units) {
  const auto distance = [](double CurvePoint::*edge) {
    return [edge](const PointLine& line) {
      return line.curve == pair_correlation ? short_cell(line.point.*edge) : std::string();
    };
  };
  Columns<PointLine> distances = {
      {"low", "d", "where a bin of pair_correlation begins", distance(&CurvePoint::low)},
      {"high", "d", "where it ends", distance(&CurvePoint::high)}};
  const auto in_d = static_cast<std::ptrdiff_t>(distances.size());
  append_in_units(distances, units);
  columns.insert(columns.end(), distances.begin() + in_d, distances.end());
}

Columns<PointLine> curve_line_columns(const Varied& varied, const GivenUnits& units) {
  Columns<PointLine> columns = columns_of_group<PointLine>(varied);
  append(columns,
         Columns<PointLine>{
             {"curve", "",
              "pair_correlation: g at a distance in d, 1 for points at random between the "
              "outermost centres of the slab; force_density: probability density of a contact "
              "force over the mean of its layer, 1 d thick",
              [](const PointLine& line) { return cell(line.curve); }},
             {"low", "d or 1", "where the bin begins",
              [](const PointLine& line) { return short_cell(line.point.low); }},
             {"high", "d or 1", "where it ends",
              [](const PointLine& line) { return short_cell(line.point.high); }},
             {"n", "", "packings that have the bin",
              [](const PointLine& line) { return cell(line.point.value.n); }}});
  append_spread(columns, "value", "", "of the curve in the bin, mean over the packings",
                [](const PointLine& line) { return line.point.value; });
  append_in_units(columns, units);
  append_distances(columns, units);
  return columns;
}

void append_points(const Group& group, std::string_view name, Curve Curves::*curve,
                   std::vector<PointLine>& lines) {
  for (const CurvePoint& point : mean_curve(group, curve)) lines.push_back({group, name, point});
}

}  // namespace

std::vector<CurvePoint> mean_curve(const Group& group, Curve Curves::*curve) {
  std::size_t longest = 0;
  double width = 0.0;
  for (const Outcome& outcome : group.settled) {
    const Curve& one = outcome.result.*curve;
    longest = std::max(longest, one.values.size());
    width = one.bin_width;
  }
  const auto values_of = [&](const PackingResult& result) -> const std::vector<double>& {
    return (result.*curve).values;
  };
  std::vector<CurvePoint> points;
  for (std::size_t k = 0; k < longest; ++k) {
    Spread spread = spread_of_entry(group, k, values_of, std::identity());
    if (spread.mean == 0.0) spread.error = no_number;  // a bin that is empty tells no error
    points.push_back({static_cast<double>(k) * width, static_cast<double>(k + 1) * width, spread});
  }
  return points;
}

CurveTable distributions_table(const Varied& varied, const GivenUnits& units) {
  const auto columns = curve_line_columns(varied, units);
  return curve_table("distributions.csv", columns, [](const Group& group) {
    std::vector<PointLine> lines;
    append_points(group, pair_correlation, &Curves::pair_correlation, lines);
    append_points(group, "force_density", &Curves::force_density, lines);
    return lines;
  });
}

}  // namespace grainsweep
