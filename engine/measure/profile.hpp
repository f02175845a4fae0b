// Profiles of one packing: how solid fraction, coordination and the share of small grains change
// from wall to wall (along x or y) and from the floor up (along z).
//
// Solid fractions come from exact volumes: each grain is cut by the planes between the bins and,
// for profiles across, by the top and the bottom of the measured slab. So the mean over the bins
// of a profile across is the solid fraction of the slab, up to rounding. Counts are of grains
// whose centre lies in the bin.
#pragma once

#include <vector>

#include "engine/measure/slab.hpp"
#include "engine/measure/touching.hpp"
#include "engine/results.hpp"

namespace grainsweep {

/// What profiles need to know besides the bed.
struct ProfileSettings {
  double bin_width = 0.1;       ///< wanted width of a bin, d
  double small_below = 0.0;     ///< grains of a smaller radius are the small class, d
  double gap_tolerance = 1e-4;  ///< grains and walls touch below this gap, d
};

/// Along what a profile is taken.
enum class ProfileAxis {
  /// Across the slab, along x or y, from wall to wall, divided into whole bins whose width is as
  /// near as possible to the wanted one. Grains of the slab are those whose centre is in it. The
  /// part of a grain that overlaps a wall belongs to the bin at the wall.
  x,
  y,
  /// In a tube, or a duct, a box between walls along x and y: over the distance from the nearest of
  /// the four walls, from 0 to half the smaller extent of the box, divided into whole bins. A bin
  /// is a square frame, in a tube a ring, as high as the slab. The mean over bins, each weighted by
  /// its area, is the solid fraction of the slab.
  from_walls,
  /// Over the whole floor, from the floor to the highest point of the bed, in bins of the wanted
  /// width, whatever the slab is.
  z,
};

template <class Kind>
Profile profile_along(ProfileAxis axis, const Bed<Kind>& bed, const Touching& touching,
                      const Slab& slab, const ProfileSettings& settings);

/// The parts of the components of a mixture, one each, in the same bins: solid fractions and counts
/// of all of them add up to those of the profile. Nothing depends on the size classes.
std::vector<ComponentProfile> component_profiles(ProfileAxis axis, const PolyhedronBed& bed,
                                                 const Touching& touching, const Slab& slab,
                                                 const ProfileSettings& settings);

}  // namespace grainsweep
