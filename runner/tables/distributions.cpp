#include "runner/tables/distributions.hpp"

#include <algorithm>

#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

/// The values of all replicates that have bin `k` of a curve.
Spread spread_at(const Group& group, Curve Order::*curve, std::size_t k) {
  std::vector<double> values;
  for (const PackingResult& result : group.settled) {
    const Curve& one = result.order.*curve;
    if (k < one.values.size()) values.push_back(one.values[k]);
  }
  return spread_of(values);
}

std::string lines_of(const Group& group, std::size_t number, const char* name,
                     Curve Order::*curve) {
  std::size_t longest = 0;
  double width = 0.0;
  for (const PackingResult& result : group.settled) {
    longest = std::max(longest, (result.order.*curve).values.size());
    width = (result.order.*curve).bin_width;
  }
  std::string text;
  for (std::size_t k = 0; k < longest; ++k) {
    const Spread spread = spread_at(group, curve, k);
    text +=
        csv_line({cell(number), cell(group.job.label), cell(group.job.box.width),
                  name_of(group.job.box.y), cell(group.job.small_share), name,
                  cell(static_cast<double>(k) * width), cell(static_cast<double>(k + 1) * width),
                  cell(spread.n), cell(spread.mean), cell(spread.sd)});
  }
  return text;
}

}  // namespace

std::string distributions_header() {
  return "group,label,width,boundary_y,small_share,curve,low,high,n,value,value_sd\n";
}

std::string distribution_lines(const Group& group, std::size_t number) {
  return lines_of(group, number, "pair_correlation", &Order::pair_correlation) +
         lines_of(group, number, "force_density", &Order::force_density);
}

}  // namespace grainsweep
