#include "runner/tables/sizes.hpp"

#include <cstddef>

namespace grainsweep {
namespace {

/// The values of all replicates in row `k`.
Spread spread_in(const Group& group, std::size_t k, double SizeRow::*share) {
  std::vector<double> values;
  for (const Outcome& outcome : group.settled) {
    const std::vector<SizeRow>& rows = outcome.result.sizes;
    if (k < rows.size()) values.push_back(rows[k].*share);
  }
  return spread_of(values);
}

struct GroupSizeLine {
  const Group& group;
  SizeLine line;
};

Columns<GroupSizeLine> size_line_columns(const Varied& varied, const GivenUnits& units) {
  using Line = GroupSizeLine;
  Columns<Line> columns;
  append(columns, group_line_columns(varied),
         [](const Line& line) -> const Group& { return line.group; });
  append(columns, Columns<Line>{
                      {"diameter", "d", "shares are of the grains that are no larger",
                       [](const Line& line) { return cell(line.line.diameter); }},
                      {"asked", "", "share in the distribution, by what sizes.distribution.by says",
                       [](const Line& line) { return cell(line.line.asked); }},
                      {"n", "", "packings that enter the means",
                       [](const Line& line) { return cell(line.line.packed.n); }}});
  append_spread(columns, "packed", "", "share in the packing, mean over the packings",
                [](const Line& line) { return line.line.packed; });
  append_spread(
      columns, "slab", "",
      "share in the measured slab, of grains whose centre is there, mean over the packings",
      [](const Line& line) { return line.line.slab; });
  append_in_units(columns, units);
  return columns;
}

}  // namespace

std::vector<SizeLine> mean_sizes(const Group& group) {
  std::vector<SizeLine> lines;
  if (group.settled.empty()) return lines;
  const std::vector<SizeRow>& rows = group.settled.front().get().result.sizes;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    lines.push_back({rows[k].diameter, rows[k].asked, spread_in(group, k, &SizeRow::packed),
                     spread_in(group, k, &SizeRow::slab)});
  }
  return lines;
}

std::vector<ColumnText> sizes_columns(const Varied& varied, const GivenUnits& units) {
  return described("sizes.csv", size_line_columns(varied, units));
}

CurveTable sizes_table(const Varied& varied, const GivenUnits& units) {
  return curve_table(size_line_columns(varied, units), [](const Group& group) {
    std::vector<GroupSizeLine> lines;
    for (const SizeLine& line : mean_sizes(group)) lines.push_back({group, line});
    return lines;
  });
}

}  // namespace grainsweep
