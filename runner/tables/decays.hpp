// decays.csv: how far the walls reach into the packings of each group, by size class.
//
// The profile of a class is followed from both walls inwards to the middle of the gap; all such
// halves of the settled replicates enter one fit. See runner/analysis/decay.hpp.
#pragma once

#include <string>
#include <vector>

#include "runner/analysis/decay.hpp"
#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

enum class GrainClass { large, small };

/// lambda_L or lambda_S of a group. Not determined without walls along y, without grains of the
/// class, or with a single settled replicate, which leaves the errors unknown.
DecayFit decay_of(const Group& group, GrainClass grains);

/// The whole file: two rows per group.
std::string decays_csv(const std::vector<Group>& groups, const GivenUnits& units = {});

std::vector<ColumnText> decays_columns(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
