// The inertia of deep grains while their bed creeps, or spheres ease on.
//
// What presses a grain is the weight above it, and a force that a solve has not found moves a grain
// by that force over its inertia. In a high bed deep grains would stray furthest, and sweeps would
// have to find their forces to a smaller and smaller share of what they carry, the higher the bed.
// So meanwhile inertia grows with depth: all grains creep alike, and a step strays as far if each
// force is found to about the same share of what it carries. Weights stay what they are; the
// moments of inertia of polyhedra change like their inertia.
//
// A step depends on its length squared over the inertia alone. So grains at the foot keep the
// inertia of their mass, steps are shorter, and the grains above are lighter:
//
//     surface    inertia  0.1     of their mass     (a bed 100 d high)
//     10 d deep           0.1     steps are 0.32 times as long as in a bed of 10 d
//     50 d                0.5
//     100 d, foot         1
#pragma once

#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Depth from which on inertia grows with it, d: in lower beds nothing changes. From 20 d on a bed
/// 160 d high takes a third more sweeps; from 5 d on deep grains of low beds creep in steps so
/// short that their solid fraction is lower by 0.0004.
inline constexpr double even_depth = 10.0;

/// Length of a step in a bed of that height, d, over that in a low one.
double shortened_step(double height);

/// Gives grains in a bed of that height, d, an inertia that grows with their depth; up to
/// even_depth that of their mass. Sets the moments of inertia of polyhedra (root_inertia), too.
void set_inertia_by_depth(double height, SphereBed& bed);
void set_inertia_by_depth(double height, PolyhedronBed& bed);

}  // namespace grainsweep
