// distributions.csv: curves of each group, a row per point, mean and scatter over the replicates.
#pragma once

#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// A bin of a group's mean curve.
struct CurvePoint {
  double low = 0.0, high = 0.0;
  Spread value;
};

/// The mean of `curve` over the settled packings of a group; bins that some of them do not have are
/// averaged over those that do.
std::vector<CurvePoint> mean_curve(const Group& group, Curve Curves::*curve);

CurveTable distributions_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
