// fits.csv: what the walls cost, per family of packings that differ in nothing but the wall gap W.
//
//   phi = phi_bulk - C / W,     Z = Z_bulk - C_Z / W,     zeta = C / phi_bulk or C_Z / Z_bulk
//
// least squares over the widths, each weighted by the standard error of its replicates' mean. A fit
// that the packings do not support is "not determined", with the reason, and has no numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/tables/groups.hpp"

namespace grainsweep {

/// Groups with equal parameters but for box.width and box.y.
struct Family {
  std::string name;             ///< its labels, and what tells it from families of the same label
  std::string parameters;       ///< canonical JSON without box.width and box.y
  std::vector<Group> walled;    ///< y walled, by ascending width
  std::vector<Group> periodic;  ///< y periodic (the unconfined reference), by ascending width
};

/// In the order in which they first appear.
std::vector<Family> families_of(const std::vector<Group>& groups);

enum class Quantity { solid_fraction, coordination };

/// The spread of `quantity` in a group.
const Spread& spread_of(const Group& group, Quantity quantity);

/// A fitted parameter and its standard error.
struct Parameter {
  double value = 0.0;
  double error = 0.0;
};

struct WallFit {
  std::string not_determined;  ///< why there is no fit; empty if there is one
  int widths = 0;              ///< different W with a settled packing
  int packings = 0;            ///< settled packings behind them
  std::string weights;         ///< "standard error of the replicates", or "equal (why)"
  Parameter bulk;              ///< phi_bulk or Z_bulk
  Parameter slope;             ///< C or C_Z, d
  Parameter zeta;              ///< slope / bulk, d
  double chi2_per_dof = 0.0;   ///< NaN with equal weights, where it means nothing
  int degrees_of_freedom = 0;
  double r_squared = 0.0;
};

WallFit fit_walls(const Family& family, Quantity quantity);

/// The widest periodic group with a settled packing: the value to compare `bulk` with.
const Group* unconfined_reference(const Family& family);

/// The whole file: two rows per family with walls.
std::string fits_csv(const std::vector<Family>& families);

}  // namespace grainsweep
