#include "runner/tables/fits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "runner/analysis/fit.hpp"

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

const char* name_of(Quantity quantity) {
  return quantity == Quantity::solid_fraction ? "solid_fraction" : "coordination";
}

/// One fit of a family.
struct FitLine {
  const Family& family;
  Quantity quantity = Quantity::solid_fraction;
  WallFit fit;
};

/// A value of a fit; empty if it is not determined.
template <class Value>
auto fit_cell(Value value) {
  return [=](const FitLine& line) {
    return line.fit.not_determined.empty() ? cell(value(line.fit)) : std::string();
  };
}

/// A value of the unconfined reference; empty if there is none.
template <class Value>
auto reference_cell(Value value) {
  return [=](const FitLine& line) {
    const Group* group = unconfined_reference(line.family);
    if (group == nullptr) return std::string();
    return cell(value(*group, spread_of(*group, line.quantity)));
  };
}

Columns<FitLine> fit_status_columns() {
  using Line = const FitLine&;
  return {
      {"family", "", "name of the packings that differ in nothing but width and boundary_y",
       [](Line line) { return cell(line.family.name); }},
      {"quantity", "", "solid_fraction or coordination",
       [](Line line) { return cell(name_of(line.quantity)); }},
      {"status", "", "determined or not determined",
       [](Line line) {
         return cell(line.fit.not_determined.empty() ? "determined" : "not determined");
       }},
      {"reason", "", "why it is not determined",
       [](Line line) { return cell(line.fit.not_determined); }},
      {"widths", "", "different widths with a settled packing",
       [](Line line) { return cell(line.fit.widths); }},
      {"packings", "", "settled packings behind them",
       [](Line line) { return cell(line.fit.packings); }},
      {"weights", "", "what the errors of the points are",
       [](Line line) { return cell(line.fit.weights); }},
  };
}

Columns<FitLine> fit_line_columns() {
  Columns<FitLine> columns = fit_status_columns();
  const auto add = [&](const char* name, const char* unit, const char* meaning,
                       Estimate WallFit::*estimate) {
    append_estimate(columns, name, unit, meaning, [=](const FitLine& line) {
      return line.fit.not_determined.empty() ? &(line.fit.*estimate) : nullptr;
    });
  };
  add("bulk", "", "the quantity without walls, in quantity = bulk - C / W", &WallFit::bulk);
  add("C", "d", "slope of the line", &WallFit::slope);
  add("zeta", "d", "C over bulk", &WallFit::zeta);
  using Fit = const WallFit&;
  using Reference = const Group&;
  using Value = const Spread&;
  append(columns,
         Columns<FitLine>{
             {"chi2_per_dof", "", "about 1 if the line holds; empty with equal weights",
              fit_cell([](Fit fit) { return fit.chi2_per_dof; })},
             {"degrees_of_freedom", "", "points less 2",
              fit_cell([](Fit fit) { return fit.degrees_of_freedom; })},
             {"r_squared", "", "share of the variance of the means that the line explains",
              fit_cell([](Fit fit) { return fit.r_squared; })},
             {"biperiodic_width", "d", "of the widest box with periodic y, the reference",
              reference_cell([](Reference group, Value /*at*/) { return group.job.box.width; })},
             {"biperiodic_mean", "", "the quantity there",
              reference_cell([](Reference /*group*/, Value at) { return at.mean; })},
             {"biperiodic_sd", "", "standard deviation of it over the replicates",
              reference_cell([](Reference /*group*/, Value at) { return at.sd; })},
             {"biperiodic_n", "", "settled packings behind it",
              reference_cell([](Reference /*group*/, Value at) { return at.n; })},
             {"parameters", "", "of the family, as JSON",
              [](const FitLine& line) { return cell(line.family.parameters); }}});
  return columns;
}

struct FitPointLine {
  const Family& family;
  Quantity quantity = Quantity::solid_fraction;
  FitPoint point;
};

Columns<FitPointLine> fit_point_columns() {
  using Line = const FitPointLine&;
  return {
      {"family", "", "as in fits.csv", [](Line line) { return cell(line.family.name); }},
      {"quantity", "", "solid_fraction or coordination",
       [](Line line) { return cell(name_of(line.quantity)); }},
      {"width", "d", "of the box along y", [](Line line) { return cell(line.point.width); }},
      {"n", "", "settled packings behind the mean", [](Line line) { return cell(line.point.n); }},
      {"mean", "", "the quantity there", [](Line line) { return cell(line.point.mean); }},
      {"error", "", "standard error of the mean; empty with equal weights",
       [](Line line) { return cell(line.point.error); }},
      {"fitted", "", "what the line says", [](Line line) { return cell(line.point.fitted); }},
      {"residual", "", "mean less fitted",
       [](Line line) { return cell(line.point.mean - line.point.fitted); }},
      {"residual_in_errors", "", "residual over error",
       [](Line line) { return cell((line.point.mean - line.point.fitted) / line.point.error); }},
  };
}

constexpr std::array fitted_quantities = {Quantity::solid_fraction, Quantity::coordination};

}  // namespace

const Spread& spread_of(const Group& group, Quantity quantity) {
  return mean_of(group, name_of(quantity));
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

std::vector<ColumnText> fits_columns() { return described("fits.csv", fit_line_columns()); }

std::vector<ColumnText> fit_points_columns() {
  return described("fit_points.csv", fit_point_columns());
}

std::string fits_csv(const std::vector<Family>& families) {
  const Columns<FitLine> columns = fit_line_columns();
  std::string text = header_line(columns);
  for (const Family& family : families) {
    if (family.walled.empty()) continue;
    for (const Quantity quantity : fitted_quantities) {
      text += row_line(columns, FitLine{family, quantity, fit_walls(family, quantity)});
    }
  }
  return text;
}

std::string fit_points_csv(const std::vector<Family>& families) {
  const Columns<FitPointLine> columns = fit_point_columns();
  std::string text = header_line(columns);
  for (const Family& family : families) {
    for (const Quantity quantity : fitted_quantities) {
      for (const FitPoint& point : fit_walls(family, quantity).points) {
        text += row_line(columns, FitPointLine{family, quantity, point});
      }
    }
  }
  return text;
}

}  // namespace grainsweep
