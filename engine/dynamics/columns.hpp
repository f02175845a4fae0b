// A tall bed of grains carries its weight.
//
// Sweeps pass forces on from contact to contact: an error that extends over the height of the bed
// takes as many sweeps to vanish as the bed has layers. But one thing is known without any sweep:
// through each horizontal plane of a bed that hardly moves the contacts pass the weight of all
// grains above it, since walls without friction carry none. All impulses are scaled so that they
// do, by factors linear in height between planes 1 d apart; sweeps then only have to correct
// short-range errors.
#pragma once

#include "engine/rows/sphere_contacts.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Beds lower than this, d, are solved as fast without it.
inline constexpr double tall_from = 40.0;

/// Height of the highest centre of a grain above the floor, d; 0 if none is above it.
double top_of(const Grains& bed);

inline bool is_tall(const Grains& bed) { return top_of(bed) > tall_from; }

/// Scales the impulses of a step of length `dt`; at most to their double or half.
template <class Real>
void carry_weight(double dt, const SphereBed& bed, SphereContacts<Real>& contacts);

}  // namespace grainsweep
