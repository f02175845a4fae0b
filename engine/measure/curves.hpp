// What is measured of one packing beyond its solid fraction and coordination: curves, and numbers
// about order and forces. Plain results; engine/measure/profile.hpp and order.hpp say how they are
// made.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace grainsweep {

/// One bin of a profile: a slice of the measured part of the bed.
struct ProfileBin {
  double large = 0.0;             ///< solid volume of the large class over the bin's volume
  double small = 0.0;             ///< the same of the small class
  std::int64_t large_grains = 0;  ///< grains of the large class whose centre is in the bin
  std::int64_t small_grains = 0;
  std::int64_t neighbours = 0;  ///< touching grains of the grains in the bin, added up
  std::int64_t walls = 0;       ///< touching walls and floor of the grains in the bin, added up
};

/// Bins of equal width along one axis; bin k reaches from k to k + 1 bin widths.
struct Profile {
  double bin_width = 0.0;  ///< d
  std::vector<ProfileBin> bins;
};

/// Values in bins of equal width from 0.
struct Curve {
  double bin_width = 0.0;
  std::vector<double> values;
};

/// Order, forces and sizes in the measured slab. A number that the slab does not give is NaN.
struct Order {
  double q6_global = 0.0;            ///< bond order of all bonds together: 0 if they point anywhere
  double q6_local = 0.0;             ///< bond order of a grain's own bonds, mean over grains
  double three_contact_share = 0.0;  ///< grains that touch exactly three grains, walls included
  double segregation = 0.0;   ///< mean height of small less that of large grains, in slab heights
  double force_mean = 0.0;    ///< of the force-bearing contacts between grains, m g
  double force_square = 0.0;  ///< mean square of a force over the mean of its layer
  Curve pair_correlation;     ///< g over distance, d
  Curve force_density;        ///< probability density of a force over the mean of its layer
};

/// How polyhedra touch and point, in the measured slab. A contact is simple at a point, double
/// along a line, triple over an area. A number that the slab does not give is NaN.
struct ShapeOrder {
  std::array<double, 3> contact_share{};  ///< of the force-bearing contacts, simple, double, triple
  std::array<double, 3> force_share{};    ///< of the sum of their forces
  std::array<double, 3> nematic{};  ///< nematic order of the axes x, y, z of the shape's frame
};

}  // namespace grainsweep
