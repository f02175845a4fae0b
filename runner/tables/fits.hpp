// fits.csv: what the walls cost, per family of packings that differ in nothing but the wall gap W.
//
//   phi = phi_bulk - C / W,     Z = Z_bulk - C_Z / W,     zeta = C / phi_bulk or C_Z / Z_bulk
//
// least squares over the widths. The error of each mean is sqrt(s^2 / n) with the variance s^2 of
// single packings pooled over all widths of the family, sum (n_i - 1) s_i^2 / sum (n_i - 1): the
// standard deviation of three replicates alone is uncertain by half its value, and weights made
// from it would let chance decide which widths count. A fit that the packings do not support is
// "not determined", with the reason, and has no numbers.
#pragma once

#include <string>
#include <vector>

#include "runner/analysis/decay.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

enum class Quantity { solid_fraction, coordination };

/// The spread of `quantity` in a group.
const Spread& spread_of(const Group& group, Quantity quantity);

/// A width of a fit: what was measured there and what the line says.
struct FitPoint {
  double width = 0.0;  ///< d
  int n = 0;           ///< settled packings behind the mean
  double mean = 0.0;
  double error = 0.0;   ///< standard error of the mean; NaN with equal weights
  double fitted = 0.0;  ///< NaN if there is no fit
};

struct WallFit {
  std::string not_determined;  ///< why there is no fit; empty if there is one
  int widths = 0;              ///< different W with a settled packing
  int packings = 0;            ///< settled packings behind them
  std::string weights;         ///< what the errors of the points are
  std::vector<FitPoint> points;
  Estimate bulk;              ///< phi_bulk or Z_bulk
  Estimate slope;             ///< C or C_Z, d
  Estimate zeta;              ///< slope / bulk, d
  double chi2_per_dof = 0.0;  ///< NaN with equal weights, where it means nothing
  int degrees_of_freedom = 0;
  double r_squared = 0.0;
};

/// Standard errors of a fit with the scatter of the points about the line: `error`, the error from
/// the replicates, times sqrt(chi2 per degree of freedom) where that exceeds 1. A line that misses
/// its points by more than their errors is known no better than it misses them.
double widened(double error, const WallFit& fit);

/// Standard error of the mean of `n` packings, from the variance pooled over all groups of the
/// family, walled and periodic; NaN where none has two settled replicates.
double pooled_error(const Family& family, Quantity quantity, int n);

WallFit fit_walls(const Family& family, Quantity quantity);

/// The widest periodic group with a settled packing: the value to compare `bulk` with.
const Group* unconfined_reference(const Family& family);

/// The whole file: two rows per family with walls.
std::string fits_csv(const std::vector<Family>& families);

/// fit_points.csv: a row per width of each fit, with the residual, in the quantity's unit and in
/// standard errors of the point.
std::string fit_points_csv(const std::vector<Family>& families);

std::vector<ColumnText> fits_columns();
std::vector<ColumnText> fit_points_columns();

}  // namespace grainsweep
