// fits.csv: what the walls cost, per family of packings that differ in nothing but the wall gap W.
//
//   phi = phi_bulk - C / W,     Z = Z_bulk - C_Z / W,     zeta = C / phi_bulk or C_Z / Z_bulk
//
// least squares over the widths, each mean with its error from groups.csv: errors from each width
// alone would let chance decide which widths count. The errors of a fit follow from those and from
// a scatter of the means about the line, if they miss it by more than their errors
// (runner/analysis/fit.hpp). A fit that the packings do not support is
// "not determined", with the reason, and has no numbers. Narrow containers, where layers fit or do
// not, are left out if there are three wider ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/analysis/decay.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

enum class Quantity { solid_fraction, coordination };

/// The spread of `quantity` in a group.
const Spread& spread_of(const Group& group, Quantity quantity);

/// How far that mean lies at most from that of beds settled ever better; nothing if not measured.
std::optional<double> bias_bound(const Group& group, Quantity quantity);

/// A width of a fit: what was measured there and what the line says.
struct FitPoint {
  const Group* group = nullptr;
  double width = 0.0;  ///< d
  int n = 0;           ///< settled packings behind the mean
  double mean = 0.0;
  double error = 0.0;   ///< standard error of the mean
  double fitted = 0.0;  ///< NaN if there is no fit
};

struct WallFit {
  std::string not_determined;  ///< why there is no fit; empty if there is one
  int widths = 0;              ///< different W of the line, with a settled packing
  int narrow_widths = 0;       ///< others that it leaves out, as no line need hold there
  int packings = 0;            ///< settled packings behind them
  std::string doubt;           ///< why the line may be none or its bulk wrong; empty if it holds
  std::string weights;         ///< what the errors of the points are
  std::vector<FitPoint> points;
  Estimate bulk;   ///< phi_bulk or Z_bulk
  Estimate slope;  ///< C or C_Z, d
  Estimate zeta;   ///< slope / bulk, d
  /// How far `bulk` lies at most from that of beds settled ever better; none if not measured.
  std::optional<double> bias_bound;
  double chi2_per_dof =
      0.0;  ///< about 1 if the line holds, less where errors come from few packings
  int degrees_of_freedom = 0;
  double scatter = 0.0;  ///< of the means about the line, beyond their errors, as the quantity
  double r_squared = 0.0;
};

WallFit fit_walls(const Family& family, Quantity quantity);

/// "2 narrow widths left out (W < 4 d, ducts and tubes < 5 d)": of a fit that leaves some out.
std::string left_out_text(const WallFit& fit);

/// The whole file: two rows per family with walls.
std::string fits_csv(const std::vector<Family>& families, const GivenUnits& units = {});

/// fit_points.csv: a row per width of each fit, with the residual, in the quantity's unit and in
/// standard errors of the point.
std::string fit_points_csv(const std::vector<Family>& families, const GivenUnits& units = {});

std::vector<ColumnText> fits_columns(const GivenUnits& units = {});
std::vector<ColumnText> fit_points_columns(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
