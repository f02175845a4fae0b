#include "runner/tables/sizes.hpp"

#include <cstddef>

namespace grainsweep {
namespace {

struct GroupSizeLine {
  const Group& group;
  SizeLine line;
};

Columns<GroupSizeLine> size_line_columns(const Varied& varied, const GivenUnits& units) {
  using Line = GroupSizeLine;
  Columns<Line> columns = columns_of_group<Line>(varied);
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
    const auto spread = [&](double SizeRow::*share) {
      return spread_of_entry(group, k, &PackingResult::sizes, share);
    };
    lines.push_back(
        {rows[k].diameter, rows[k].asked, spread(&SizeRow::packed), spread(&SizeRow::slab)});
  }
  return lines;
}

CurveTable sizes_table(const Varied& varied, const GivenUnits& units) {
  return curve_table("sizes.csv", size_line_columns(varied, units), [](const Group& group) {
    std::vector<GroupSizeLine> lines;
    for (const SizeLine& line : mean_sizes(group)) lines.push_back({group, line});
    return lines;
  });
}

}  // namespace grainsweep
