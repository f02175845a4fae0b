#include "runner/tables/fits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/measure/fit.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::vector<const Group*> groups_with_values(const Family& family) {
  std::vector<const Group*> groups;
  for (const Group& group : family.walled) {
    if (group.counts.settled > 0) groups.push_back(&group);
  }
  return groups;
}

std::string why_not_determined(const std::vector<const Group*>& groups, int widths) {
  if (widths < 3) {
    return "needs settled packings at 3 or more widths with otherwise equal parameters, has " +
           std::to_string(widths);
  }
  const auto is_single = [](const Group* group) { return group->counts.settled < 2; };
  if (!std::all_of(groups.begin(), groups.end(), is_single)) return "";
  return "needs 2 or more settled replicates to know the errors, has 1 at every width";
}

/// "5, 6": the widths at which the replicates give no error to weigh with.
std::string widths_without_error(const std::vector<const Group*>& groups, Quantity quantity) {
  std::string widths;
  for (const Group* group : groups) {
    if (standard_error(spread_of(*group, quantity)) > 0) continue;
    widths += (widths.empty() ? "" : ", ") + cell(group->job.box.width);
  }
  return widths;
}

Parameter zeta_of(const LineFit& line) {
  const double bulk = line.intercept, slope = -line.slope;
  const double variance = std::pow(line.slope_error / bulk, 2) +
                          std::pow(slope * line.intercept_error / (bulk * bulk), 2) +
                          2.0 * slope / (bulk * bulk * bulk) * line.covariance;
  return {slope / bulk, std::sqrt(std::max(0.0, variance))};
}

void take_line(const LineFit& line, FitWeights weights, WallFit& fit) {
  const bool is_weighted = weights == FitWeights::by_error;
  fit.bulk = {line.intercept, line.intercept_error};
  fit.slope = {-line.slope, line.slope_error};
  fit.zeta = zeta_of(line);
  fit.degrees_of_freedom = line.degrees_of_freedom;
  fit.chi2_per_dof = is_weighted ? line.chi2 / line.degrees_of_freedom : none;
  fit.r_squared = line.r_squared;
}

std::vector<std::string> fit_cells(const WallFit& fit) {
  if (!fit.not_determined.empty()) return std::vector<std::string>(9);
  return {cell(fit.bulk.value),   cell(fit.bulk.error),         cell(fit.slope.value),
          cell(fit.slope.error),  cell(fit.zeta.value),         cell(fit.zeta.error),
          cell(fit.chi2_per_dof), cell(fit.degrees_of_freedom), cell(fit.r_squared)};
}

std::vector<std::string> reference_cells(const Family& family, Quantity quantity) {
  const Group* group = unconfined_reference(family);
  if (group == nullptr) return std::vector<std::string>(4);
  const Spread& spread = spread_of(*group, quantity);
  return {cell(group->job.box.width), cell(spread.mean), cell(spread.sd), cell(spread.n)};
}

std::string fit_line_of_csv(const Family& family, Quantity quantity) {
  const WallFit fit = fit_walls(family, quantity);
  const bool is_determined = fit.not_determined.empty();
  std::vector<std::string> cells = {
      cell(family.name),
      quantity == Quantity::solid_fraction ? "solid_fraction" : "coordination",
      is_determined ? "determined" : "not determined",
      cell(fit.not_determined),
      cell(fit.widths),
      cell(fit.packings),
      cell(fit.weights)};
  for (std::string& text : fit_cells(fit)) cells.push_back(std::move(text));
  for (std::string& text : reference_cells(family, quantity)) cells.push_back(std::move(text));
  cells.push_back(cell(family.parameters));
  return csv_line(cells);
}

}  // namespace

const Spread& spread_of(const Group& group, Quantity quantity) {
  return quantity == Quantity::solid_fraction ? group.solid_fraction : group.coordination;
}

WallFit fit_walls(const Family& family, Quantity quantity) {
  const std::vector<const Group*> groups = groups_with_values(family);
  WallFit fit;
  std::set<double> widths;
  std::vector<LinePoint> points;
  for (const Group* group : groups) {
    const Spread& spread = spread_of(*group, quantity);
    widths.insert(group->job.box.width);
    fit.packings += spread.n;
    points.push_back({1.0 / group->job.box.width, spread.mean, standard_error(spread)});
  }
  fit.widths = static_cast<int>(widths.size());
  fit.not_determined = why_not_determined(groups, fit.widths);
  if (!fit.not_determined.empty()) return fit;
  const std::string unweighable = widths_without_error(groups, quantity);
  const FitWeights weights = unweighable.empty() ? FitWeights::by_error : FitWeights::equal;
  const auto line = fit_line(points, weights);
  fit.weights = unweighable.empty() ? "standard error of the replicates"
                                    : "equal (no scatter of replicates at W = " + unweighable + ")";
  if (line) {
    take_line(*line, weights, fit);
  } else {
    fit.not_determined = "a mean value is not a number";
  }
  return fit;
}

const Group* unconfined_reference(const Family& family) {
  const Group* widest = nullptr;
  for (const Group& group : family.periodic) {
    if (group.counts.settled > 0) widest = &group;
  }
  return widest;
}

std::string fits_csv(const std::vector<Family>& families) {
  std::string text =
      "family,quantity,status,reason,widths,packings,weights,bulk,bulk_error,C,C_error,zeta,"
      "zeta_error,chi2_per_dof,degrees_of_freedom,r_squared,biperiodic_width,biperiodic_mean,"
      "biperiodic_sd,biperiodic_n,parameters\n";
  for (const Family& family : families) {
    if (family.walled.empty()) continue;
    text += fit_line_of_csv(family, Quantity::solid_fraction);
    text += fit_line_of_csv(family, Quantity::coordination);
  }
  return text;
}

}  // namespace grainsweep
