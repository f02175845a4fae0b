#include "runner/tables/fits.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/measure/fit.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

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

/// Variance of a single packing about the mean of its width, and its degrees of freedom.
struct Pooled {
  double variance = 0.0;
  int degrees_of_freedom = 0;
};

Pooled pooled_over(const std::vector<const Group*>& groups, Quantity quantity) {
  Pooled pooled;
  double squares = 0.0;
  for (const Group* group : groups) {
    const Spread& spread = spread_of(*group, quantity);
    if (spread.n < 2) continue;
    squares += (spread.n - 1) * spread.sd * spread.sd;
    pooled.degrees_of_freedom += spread.n - 1;
  }
  if (pooled.degrees_of_freedom > 0) pooled.variance = squares / pooled.degrees_of_freedom;
  return pooled;
}

std::vector<FitPoint> points_of(const std::vector<const Group*>& groups, Quantity quantity,
                                const Pooled& pooled) {
  std::vector<FitPoint> points;
  for (const Group* group : groups) {
    const Spread& spread = spread_of(*group, quantity);
    const double error = pooled.variance > 0 ? std::sqrt(pooled.variance / spread.n) : no_number;
    points.push_back({group->job.box.width, spread.n, spread.mean, error, no_number});
  }
  return points;
}

std::string weights_text(const Pooled& pooled) {
  if (!(pooled.variance > 0)) return "equal (the replicates do not scatter)";
  return "variance of the replicates pooled over the widths (" +
         std::to_string(pooled.degrees_of_freedom) + " degrees of freedom)";
}

Estimate zeta_of(const LineFit& line) {
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
  fit.chi2_per_dof = is_weighted ? line.chi2 / line.degrees_of_freedom : no_number;
  fit.r_squared = line.r_squared;
  for (FitPoint& point : fit.points) point.fitted = line.intercept + line.slope / point.width;
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

const char* name_of(Quantity quantity) {
  return quantity == Quantity::solid_fraction ? "solid_fraction" : "coordination";
}

std::string point_lines_of_csv(const Family& family, Quantity quantity) {
  std::string text;
  for (const FitPoint& point : fit_walls(family, quantity).points) {
    const double residual = point.mean - point.fitted;
    text += csv_line({cell(family.name), name_of(quantity), cell(point.width), cell(point.n),
                      cell(point.mean), cell(point.error), cell(point.fitted), cell(residual),
                      cell(residual / point.error)});
  }
  return text;
}

std::string fit_line_of_csv(const Family& family, Quantity quantity) {
  const WallFit fit = fit_walls(family, quantity);
  const bool is_determined = fit.not_determined.empty();
  std::vector<std::string> cells = {
      cell(family.name),        name_of(quantity), is_determined ? "determined" : "not determined",
      cell(fit.not_determined), cell(fit.widths),  cell(fit.packings),
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

double widened(double error, const WallFit& fit) {
  return fit.chi2_per_dof > 1.0 ? error * std::sqrt(fit.chi2_per_dof) : error;
}

double pooled_error(const Family& family, Quantity quantity, int n) {
  std::vector<const Group*> groups;
  for (const Group& group : family.walled) groups.push_back(&group);
  for (const Group& group : family.periodic) groups.push_back(&group);
  const Pooled pooled = pooled_over(groups, quantity);
  return pooled.degrees_of_freedom > 0 && n > 0 ? std::sqrt(pooled.variance / n) : no_number;
}

WallFit fit_walls(const Family& family, Quantity quantity) {
  const std::vector<const Group*> groups = groups_with_values(family);
  const Pooled pooled = pooled_over(groups, quantity);
  WallFit fit;
  fit.points = points_of(groups, quantity, pooled);
  std::set<double> widths;
  std::vector<LinePoint> points;
  for (const FitPoint& point : fit.points) {
    widths.insert(point.width);
    fit.packings += point.n;
    points.push_back({1.0 / point.width, point.mean, point.error});
  }
  fit.widths = static_cast<int>(widths.size());
  fit.not_determined = why_not_determined(groups, fit.widths);
  if (!fit.not_determined.empty()) return fit;
  const FitWeights weights = pooled.variance > 0 ? FitWeights::by_error : FitWeights::equal;
  fit.weights = weights_text(pooled);
  const auto line = fit_line(points, weights);
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

std::string fit_points_csv(const std::vector<Family>& families) {
  std::string text = "family,quantity,width,n,mean,error,fitted,residual,residual_in_errors\n";
  for (const Family& family : families) {
    text += point_lines_of_csv(family, Quantity::solid_fraction);
    text += point_lines_of_csv(family, Quantity::coordination);
  }
  return text;
}

}  // namespace grainsweep
