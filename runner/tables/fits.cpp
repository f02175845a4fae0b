#include "runner/tables/fits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "runner/analysis/fit.hpp"
#include "runner/sweep/bed_kind.hpp"
#include "runner/text.hpp"

namespace grainsweep {
namespace {

/// Those with a settled packing; and which of them the line goes through.
struct FittedGroups {
  std::vector<const Group*> on_line;
  std::set<double> left_out;  ///< narrow widths, d
};

FittedGroups groups_of_fit(const Family& family) {
  std::vector<const Group*> groups;
  std::vector<LineWidth> widths;
  for (const Group& group : family.walled) {
    if (group.counts.settled == 0) continue;
    groups.push_back(&group);
    widths.push_back({group.job.box.width, is_narrow(group.job.box)});
  }
  const std::vector<bool> are_on_line = widths_on_line(widths);
  FittedGroups fitted;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (are_on_line[k])
      fitted.on_line.push_back(groups[k]);
    else
      fitted.left_out.insert(widths[k].width);
  }
  return fitted;
}

std::string why_not_determined(const std::vector<const Group*>& groups, Quantity quantity,
                               int widths) {
  if (widths < static_cast<int>(least_widths_of_line)) {
    return "needs settled packings at 3 or more widths with otherwise equal parameters, has " +
           std::to_string(widths);
  }
  return why_no_error(spread_of(*groups.front(), quantity));
}

std::vector<FitPoint> points_of(const std::vector<const Group*>& groups, Quantity quantity) {
  std::vector<FitPoint> points;
  for (const Group* group : groups) {
    const Spread& spread = spread_of(*group, quantity);
    points.push_back({group, group->job.box.width, spread.n, spread.mean, spread.error, no_number});
  }
  return points;
}

/// Degrees of freedom from which the errors of the groups' means are known.
std::set<double> degrees_of_errors(const std::vector<FitPoint>& points, Quantity quantity) {
  std::set<double> degrees;
  for (const FitPoint& point : points) {
    degrees.insert(spread_of(*point.group, quantity).degrees_of_freedom);
  }
  return degrees;
}

std::string weights_text(const std::vector<FitPoint>& points, Quantity quantity) {
  const std::set<double> degrees = degrees_of_errors(points, quantity);
  const std::string low = fixed(*degrees.begin(), 0), high = fixed(*degrees.rbegin(), 0);
  return "variance times volume of the slab of the replicates and of others of the family (" + low +
         (low == high ? "" : " to " + high) + " degrees of freedom)";
}

Estimate zeta_of(const LineFit& line) {
  const double bulk = line.intercept, slope = -line.slope;
  const double variance = std::pow(line.slope_error / bulk, 2) +
                          std::pow(slope * line.intercept_error / (bulk * bulk), 2) +
                          2.0 * slope / (bulk * bulk * bulk) * line.covariance;
  return {slope / bulk, std::sqrt(std::max(0.0, variance))};
}

void take_line(const LineFit& line, WallFit& fit) {
  fit.bulk = {line.intercept, line.intercept_error};
  fit.slope = {-line.slope, line.slope_error};
  fit.zeta = zeta_of(line);
  fit.degrees_of_freedom = line.degrees_of_freedom;
  fit.chi2_per_dof = line.chi2 / line.degrees_of_freedom;
  fit.scatter = line.scatter;
  fit.r_squared = line.r_squared;
  for (FitPoint& point : fit.points) point.fitted = line.intercept + line.slope / point.width;
}

/// Whether the points miss the line, which knows of no scatter, by no more than chance lets them.
/// Errors that come from few packings leave room for much. So the points with better known ones are
/// also looked at alone: one that is hardly known does not excuse all others.
bool may_be_straight(const LineFit& line, const std::vector<FitPoint>& points, Quantity quantity) {
  const std::set<double> degrees = degrees_of_errors(points, quantity);
  return std::all_of(degrees.begin(), degrees.end(), [&](double least) {
    double chi2 = 0.0;
    int left = -2;  // degrees of freedom
    for (const FitPoint& point : points) {
      if (spread_of(*point.group, quantity).degrees_of_freedom < least) continue;
      const double miss = point.mean - line.intercept - line.slope / point.width;
      chi2 += std::pow(miss / point.error, 2);
      ++left;
    }
    return left < 1 || may_hold({chi2 / left, left, least});
  });
}

/// Why a line may be none; empty if it may.
std::string doubt_of(const LineFit& line, const std::vector<FitPoint>& points, Quantity quantity) {
  if (!may_be_straight(line, points, quantity)) return "the straight line does not hold";
  const bool has_narrow = std::any_of(points.begin(), points.end(), [](const FitPoint& point) {
    return is_narrow(point.group->job.box);
  });
  return has_narrow ? std::string("no line need hold in narrow containers ") + narrow_containers
                    : "";
}

/// Groups of a family differ only in their width: narrow ones may have a larger bound than others.
/// That of the worst holds for a straight line through their means; none if one has none.
std::optional<double> bias_bound(const std::vector<const Group*>& groups, Quantity quantity) {
  std::optional<double> largest = 0.0;
  for (const Group* group : groups) {
    const auto bound = bias_bound(*group, quantity);
    largest = largest && bound ? std::optional(std::max(*largest, *bound)) : std::nullopt;
  }
  return largest;
}

/// Whether the containers of a line keep walls along x however wide they are.
bool keeps_walls(const Family& family) {
  const Box& box = first_group(family).job.box;
  return !box.is_tube && box.x == Boundary::walls &&
         !std::all_of(family.walled.begin(), family.walled.end(),
                      [](const Group& group) { return is_square_duct(group.job.box); });
}

/// Whether the value of a line without walls is not the one measured there, by three errors of
/// both. What settling does to means has no part in it: both are settled alike.
bool contradicts(const WallFit& fit, const Family& family, Quantity quantity) {
  constexpr double most_errors = 3.0;
  if (!family.unconfined || keeps_walls(family)) return false;
  const Spread& periodic = spread_of(*family.unconfined, quantity);
  const double error = std::hypot(fit.bulk.error, periodic.error);
  return std::abs(fit.bulk.value - periodic.mean) > most_errors * error;  // not of NaN
}

constexpr const char* other_bulk =
    "bulk and periodic value differ by more than their errors: too few or too narrow widths";

const char* name_of(Quantity quantity) {
  return quantity == Quantity::solid_fraction ? "solid_fraction" : "coordination";
}

/// One fit of a family.
struct FitLine {
  const Family& family;
  Quantity quantity = Quantity::solid_fraction;
  WallFit fit;
};

/// A value of the unconfined reference; empty if there is none.
template <class Value>
auto reference_cell(Value value) {
  return [=](const FitLine& line) {
    const std::optional<Group>& group = line.family.unconfined;
    if (!group) return std::string();
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
      fit_status_column<FitLine>(),
      {"reason", "", "why it is not determined, or not to be trusted",
       [](Line line) { return cell(line.fit.not_determined + line.fit.doubt); }},
      {"widths", "", "different widths of the line, with a settled packing",
       [](Line line) { return cell(line.fit.widths); }},
      {"packings", "", "settled packings behind them",
       [](Line line) { return cell(line.fit.packings); }},
      {"weights", "", "what the errors of the points are",
       [](Line line) { return cell(line.fit.weights); }},
  };
}

Columns<FitLine> fit_line_columns(const GivenUnits& units) {
  Columns<FitLine> columns = fit_status_columns();
  const auto add = [&](const char* name, const char* unit, const char* meaning,
                       Estimate WallFit::*estimate) {
    append_estimate(columns, name, unit, meaning, estimate);
  };
  add("bulk", "", "the quantity without walls along y, in quantity = bulk - C / W", &WallFit::bulk);
  add("C", "d", "slope of the line", &WallFit::slope);
  add("zeta", "d", "C over bulk", &WallFit::zeta);
  using Reference = const Group&;
  using Value = const Spread&;
  append(
      columns,
      Columns<FitLine>{
          {"bulk_bias_bound", "",
           "how far bulk lies at most from that of beds settled ever better; empty if not "
           "measured",
           fit_cell([](const WallFit& fit) { return fit.bias_bound.value_or(no_number); })},
          {"chi2_per_dof", "", "about 1 or less if the line holds, of the line without scatter",
           fit_cell(&WallFit::chi2_per_dof)},
          {"scatter", "",
           "standard deviation of the means about the line beyond their errors, with which chi2 "
           "would be 1; part of the errors of bulk, C and zeta",
           fit_cell(&WallFit::scatter)},
          {"degrees_of_freedom", "", "points less 2", fit_cell(&WallFit::degrees_of_freedom)},
          {"r_squared", "",
           "share of the variance of the means that the line explains, both weighted by the "
           "points' errors",
           fit_cell(&WallFit::r_squared)},
          {"biperiodic_width", "d",
           "of the reference, the widest box without walls: of the family, or, if it has none, as "
           "a tube, of another one that differs in nothing but its container and its fill",
           reference_cell([](Reference group, Value /*at*/) { return group.job.box.width; })},
          {"biperiodic_mean", "", "the quantity there",
           reference_cell([](Reference /*group*/, Value at) { return at.mean; })},
          {"biperiodic_sd", "", "standard deviation of it over the replicates",
           reference_cell([](Reference /*group*/, Value at) { return at.sd; })},
          {"biperiodic_n", "", "settled packings behind it",
           reference_cell([](Reference /*group*/, Value at) { return at.n; })},
          {"narrow_widths", "",
           "widths that the line leaves out, as none need hold in narrow containers (W below 4 d, "
           "ducts and tubes 5 d): none where fewer than three wider ones are left",
           [](const FitLine& line) { return cell(line.fit.narrow_widths); }},
          {"parameters", "", "of the family, as JSON",
           [](const FitLine& line) { return cell(line.family.parameters); }}});
  append_in_units(columns, units);
  return columns;
}

struct FitPointLine {
  Quantity quantity = Quantity::solid_fraction;
  FitPoint point;
};

Columns<FitPointLine> fit_point_columns(const Varied& varied, const GivenUnits& units) {
  using Line = const FitPointLine&;
  Columns<Group> of_group = group_key_columns();
  append(of_group, job_columns({"job", "label", "boundary_y", "small_share"}),
         [](const Group& group) -> const JobFacts& { return group.job; });
  append(of_group, varied_columns(varied));
  Columns<FitPointLine> columns;
  append(columns, of_group, [](Line line) -> const Group& { return *line.point.group; });
  append(
      columns,
      Columns<FitPointLine>{
          {"quantity", "", "solid_fraction or coordination",
           [](Line line) { return cell(name_of(line.quantity)); }},
          {"width", "d", "gap between the walls, of a tube its diameter",
           [](Line line) { return cell(line.point.width); }},
          {"n", "", "settled packings behind the mean",
           [](Line line) { return cell(line.point.n); }},
          {"mean", "", "the quantity there", [](Line line) { return cell(line.point.mean); }},
          {"error", "", "standard error of the mean, as in groups.csv",
           [](Line line) { return cell(line.point.error); }},
          {"fitted", "", "what the line says", [](Line line) { return cell(line.point.fitted); }},
          {"residual", "", "mean less fitted",
           [](Line line) { return cell(line.point.mean - line.point.fitted); }},
          {"residual_in_errors", "", "residual over error", [](Line line) {
             return cell((line.point.mean - line.point.fitted) / line.point.error);
           }}});
  append_in_units(columns, units);
  return columns;
}

constexpr std::array fitted_quantities = {Quantity::solid_fraction, Quantity::coordination};

}  // namespace

std::optional<double> bias_bound(const Group& group, Quantity quantity) {
  if (!group.bias_bound) return std::nullopt;
  const double bound = quantity == Quantity::solid_fraction ? group.bias_bound->solid_fraction
                                                            : group.bias_bound->coordination;
  return std::isnan(bound) ? std::nullopt : std::optional(bound);
}

const Spread& spread_of(const Group& group, Quantity quantity) {
  return mean_of(group, name_of(quantity));
}

std::string left_out_text(const WallFit& fit) {
  return std::to_string(fit.narrow_widths) + " narrow width" + (fit.narrow_widths == 1 ? "" : "s") +
         " left out " + narrow_containers;
}

WallFit fit_walls(const Family& family, Quantity quantity) {
  const auto [groups, left_out] = groups_of_fit(family);
  WallFit fit;
  fit.narrow_widths = static_cast<int>(left_out.size());
  fit.points = points_of(groups, quantity);
  std::set<double> widths;
  std::vector<LinePoint> points;
  for (const FitPoint& point : fit.points) {
    widths.insert(point.width);
    fit.packings += point.n;
    points.push_back({1.0 / point.width, point.mean, point.error});
  }
  fit.widths = static_cast<int>(widths.size());
  fit.not_determined = why_not_determined(groups, quantity, fit.widths);
  if (!fit.not_determined.empty()) return fit;
  fit.weights = weights_text(fit.points, quantity);
  fit.bias_bound = bias_bound(groups, quantity);
  if (const auto line = fit_line(points)) {
    fit.doubt = doubt_of(*line, fit.points, quantity);
    take_line(fit_scattered_line(points).value(), fit);
    if (contradicts(fit, family, quantity)) {
      fit.doubt += (fit.doubt.empty() ? "" : "; ") + std::string(other_bulk);
    }
  } else {
    fit.not_determined = "a mean value is not a number";
  }
  return fit;
}

std::vector<ColumnText> fits_columns(const GivenUnits& units) {
  return described("fits.csv", fit_line_columns(units));
}

std::vector<ColumnText> fit_points_columns(const Varied& varied, const GivenUnits& units) {
  return described("fit_points.csv", fit_point_columns(varied, units));
}

std::string fits_csv(const std::vector<Family>& families, const GivenUnits& units) {
  const Columns<FitLine> columns = fit_line_columns(units);
  std::string text = header_line(columns);
  for (const Family& family : families) {
    if (family.walled.empty()) continue;
    for (const Quantity quantity : fitted_quantities) {
      text += row_line(columns, FitLine{family, quantity, fit_walls(family, quantity)});
    }
  }
  return text;
}

std::string fit_points_csv(const std::vector<Family>& families, const GivenUnits& units) {
  const Columns<FitPointLine> columns = fit_point_columns(
      families.empty() ? Varied() : varied_of(first_group(families.front())), units);
  std::string text = header_line(columns);
  for (const Family& family : families) {
    for (const Quantity quantity : fitted_quantities) {
      for (const FitPoint& point : fit_walls(family, quantity).points) {
        text += row_line(columns, FitPointLine{quantity, point});
      }
    }
  }
  return text;
}

}  // namespace grainsweep
