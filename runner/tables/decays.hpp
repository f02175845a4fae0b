// decays.csv: how far the walls reach into the packings of each group, by size class.
//
// The profile of a class is followed from both walls inwards to the middle of the gap, in a tube
// from the wall to the axis; all such halves of the settled replicates enter one fit. See
// runner/analysis/decay.hpp.
#pragma once

#include "runner/analysis/decay.hpp"
#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

enum class GrainClass { large, small };

/// The profile that shows the layers beside the walls: along y, in a tube over the distance from
/// the wall.
Profile PackingResult::*profile_across(const Group& group);

/// lambda_L or lambda_S of a group. Not determined without walls along y, where a packing has no
/// grains of the class, or with a single settled replicate, which leaves the errors unknown.
DecayFit decay_of(const Group& group, GrainClass grains);

/// Two rows per group.
CurveTable decays_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
