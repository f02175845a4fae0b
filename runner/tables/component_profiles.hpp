// component_profiles.csv: how solid fraction, neighbours and nematic order of each component of a
// mixture change across the gap and from the floor up, mean and scatter over the replicates of each
// group.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runner/tables/groups.hpp"
#include "runner/tables/units.hpp"

namespace grainsweep {

/// A bin of a component's mean profile. All but the solid fraction count the grains of the
/// component whose centre lies in the bin; replicates without such grains do not enter it.
struct MeanComponentBin {
  double low = 0.0, high = 0.0;  ///< d
  Spread solid_fraction;
  Spread neighbours;               ///< grains of the other component that one of them touches
  Spread coordination;             ///< grains of any component
  Spread coordination_with_walls;  ///< the same, walls and floor counted
  std::array<Spread, 3> nematic;   ///< of the axes of its shape's frame; none of spheres
};

/// The mean of component `k`'s `profile` over the settled packings of a group, its neighbours being
/// those of component `other`, both from 0. Empty if there is no such component.
std::vector<MeanComponentBin> mean_component_profile(const Group& group,
                                                     ComponentProfile ComponentMeasure::*profile,
                                                     std::size_t k, std::size_t other);

/// The file: along x and y, from the walls and along z of each group, for each pair of components.
CurveTable component_profiles_table(const Varied& varied, const GivenUnits& units = {});

}  // namespace grainsweep
