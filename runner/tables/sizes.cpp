#include "runner/tables/sizes.hpp"

#include <algorithm>
#include <cmath>
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
                       [](const Line& line) { return short_cell(line.line.diameter); }},
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

bool has_size_distribution(const JobFacts& job) {
  if (job.parameters.text().find("\"distribution\":") == std::string::npos) return false;
  const auto parameters = identifying_parameters(job);
  return !parameters.contains("fill.file") && !parameters.contains("fill.files");
}

std::string size_weight(const JobFacts& job) {
  const auto parameters = flat_parameters(job);
  const auto by = parameters.find("sizes.distribution.by");
  return by == parameters.end() ? "volume" : by->second;
}

std::optional<SizeLine> slab_difference(const Group& group) {
  constexpr double least_share = 0.02, tenth = 0.1, half = 0.5;
  constexpr double errors_by_chance = 2.0;
  const std::vector<SizeLine> lines = mean_sizes(group);
  std::optional<SizeLine> largest;
  double most = 0.0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Spread difference = spread_of_entry(
        group, k, &PackingResult::sizes, [](const SizeRow& row) { return row.slab - row.packed; });
    const double share = lines[k].packed.mean, size = std::abs(difference.mean);
    const double least = difference.n > 1
                             ? std::max(tenth * share, errors_by_chance * difference.error)
                             : half * share;
    if (share < least_share || !(size > least) || size <= most) continue;
    largest = lines[k];
    most = size;
  }
  return largest;
}

CurveTable sizes_table(const Varied& varied, const GivenUnits& units) {
  return curve_table("sizes.csv", size_line_columns(varied, units), [](const Group& group) {
    std::vector<GroupSizeLine> lines;
    for (const SizeLine& line : mean_sizes(group)) lines.push_back({group, line});
    return lines;
  });
}

}  // namespace grainsweep
