// Bond order: do the directions from grain to grain repeat, as in a crystal?
//
//   Q6^2 = 4 pi / 13  sum over m of |mean over bonds of Y6m|^2
// (Steinhardt, Nelson, Ronchetti 1983), which no rotation changes: 0.57452 in a face-centred cubic
// crystal, 0.35355 in a simple cubic one, 0 for bonds in all directions alike. Two grains are
// bonded if their gap is below 0.2 times the mean of their diameters, and below 0.2 d.
#pragma once

#include "engine/measure/slab.hpp"
#include "engine/measure/touching.hpp"

namespace grainsweep {

/// Gap below which two grains of these radii count as bonded, d.
double bond_gap(double radius_a, double radius_b);
/// Upper bound of bond_gap, d.
inline constexpr double longest_bond_gap = 0.2;

struct BondOrder {
  double global = 0.0;  ///< of all bonds of the slab's grains together
  double local = 0.0;   ///< of each grain's bonds, mean over the slab's grains that have any
};

/// Of the grains whose centre lies in the slab; `near` must hold all pairs with a gap below their
/// bond_gap. NaN without bonds.
BondOrder bond_order(const Grains& bed, const Touching& near, const Slab& slab);

}  // namespace grainsweep
