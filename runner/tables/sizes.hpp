// sizes.csv: distributions of grain sizes, asked and packed, a row per diameter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// The share of the grains up to a diameter.
struct SizeLine {
  double diameter = 0.0;  ///< d
  double asked = 0.0;     ///< of the distribution
  Spread packed, slab;    ///< of all grains, and of those in the measured slab
};

/// Over the settled packings of a group, from fine to coarse; empty for grains without a
/// distribution.
std::vector<SizeLine> mean_sizes(const Group& group);

/// Whether the sizes of its grains are drawn from a distribution. Those of a file are not, whatever
/// distribution stands beside it.
bool has_size_distribution(const JobFacts& job);

/// What the shares of its distribution are shares of: "volume", "area" or "number".
std::string size_weight(const JobFacts& job);

/// The row of sizes.csv at which the measured slab differs most from the whole bed, by more than
/// a tenth of the share there and more than chance does; none where it differs nowhere so. Rows
/// with less than 2 % of the grains up to them do not count. A single packing tells no scatter:
/// there it has to be half of the share.
std::optional<SizeLine> slab_difference(const Group& group);

CurveTable sizes_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
