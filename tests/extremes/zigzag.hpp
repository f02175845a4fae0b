// A tower of equal spheres that lean on the walls of a narrow box in turn: each lies in one corner
// of it, the next one in the opposite corner.
//
// Centres of neighbours are (.6, .6, h) apart, h^2 = 1 - .72. So the contact that carries a weight
// P pushes with P / h, and a grain between two of them presses .6 (P + P') / h on each of two
// walls. A tower of n grains has 3 n contacts: it is isostatic, and it is stable.
#pragma once

#include <vector>

#include "engine/scene/bed.hpp"

namespace grainsweep::extremes {

inline constexpr double zigzag_side = 1.6;                  ///< of the box, d
inline constexpr double zigzag_rise = 0.52915026221291812;  ///< h = sqrt(.28)
inline constexpr double zigzag_across = 0.6;

/// Spheres of diameter 1 and these masses, the first on the floor, each `gap` higher above the one
/// below it than where it touches.
SphereBed zigzag_bed(const std::vector<double>& masses, double gap);

/// Weight that the contact under grain k carries, m g.
std::vector<double> carried_weights(const std::vector<double>& masses);

}  // namespace grainsweep::extremes
