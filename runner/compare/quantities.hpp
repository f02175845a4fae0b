// The numbers of a family that can be set beside published ones, by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runner/analysis/decay.hpp"
#include "runner/analysis/fit.hpp"
#include "runner/tables/families.hpp"

namespace grainsweep {

struct Measured {
  Estimate estimate;           ///< value and standard error, in d where it is a length
  std::string not_determined;  ///< why there is no value; empty if there is one
  std::string definition;      ///< of the value
  /// How far it lies at most from that of beds settled ever better; 0 if that was not measured.
  double bias_bound = 0.0;
};

/// Why there can be no such value: an unknown name, or a width that is missing or has no meaning
/// for the quantity; empty if there can be one.
std::string fault_of_quantity(const std::string& quantity, double width);

/// Whether its values are shares of a volume, 0 to 1.
bool is_share(std::string_view quantity);

/// Whether it can have the value: a share of a volume none beyond 0 to 1, and none an infinite one.
bool is_possible(std::string_view quantity, double value);

/// Whether it is one value of a family, which belongs to no width.
bool is_of_family(const std::string& quantity);

/// Whether it is a mean over the packings of a width, which single packings have, too, without an
/// error.
bool is_mean_of_width(std::string_view quantity);

/// "Z at W = 10 d", with `symbol` from extent_symbol. The quantity and width must be without fault,
/// here and below.
std::string title_of_quantity(const std::string& quantity, double width, const std::string& symbol);

/// `folder` holds the beds, as for GroupWithCurves.
Measured measure_quantity(const std::string& quantity, double width, const Family& family,
                          const std::string& folder = "");

/// A quantity of a width, of a group of the family.
Measured measure_quantity(const std::string& quantity, const Family& family, const Group& group,
                          const std::string& folder = "");

/// phi, porosity or Z (is_mean_of_width) at these distances from the nearest wall, d, between walls
/// that are `width` apart: its profile, linear between the middles of bins, of both halves of a
/// gap. Also tells the group that it is of, the first one of that width; null if there is none.
struct MeasuredProfile {
  const Group* group = nullptr;
  std::vector<Measured> values;  ///< one for each distance
};
MeasuredProfile measure_profile(const std::string& quantity, double width,
                                const std::vector<double>& distances, const Family& family,
                                const std::string& folder = "");

/// The mean of a quantity over all families, weighted by their errors, with its error and, in the
/// definition, chi2 per degree of freedom: whether one value holds for all.
struct Shared {
  Measured measured;
  Misfit misfit;
};
Shared share_quantity(const std::string& quantity, double width,
                      const std::vector<Family>& families, const std::string& folder = "");

}  // namespace grainsweep
