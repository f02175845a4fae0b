// A step's impulses as changes of the last step's.
//
// At the foot of a high bed contacts push with hundreds of weights, and f32 keeps seven digits of
// that: sweeps, and momentum even more so, accumulate rounding errors until a bed of 100 d misses
// balance by hundredths of a weight, which taps it and keeps it from being found at rest. From step
// to step impulses change by far less than their size. So the motion that the last step's impulses
// give, and what it leaves of each gap, are computed once in f64; the sweeps then solve only for
// the changes of impulses and motion, in f32 with nearly the digits of f64.
#pragma once

#include "engine/dynamics/columns.hpp"
#include "engine/dynamics/solve.hpp"

namespace grainsweep {

/// Beds lower than this, d, come to rest as soon without it: f32 leaves 1e-4 m g for every d of
/// height.
inline constexpr double high_from = 100.0;

/// Whether steps in f32 solve for changes, in stages that carry (StepSettings::carries). Those of
/// polyhedra never do.
inline bool is_high(const SphereBed& bed) { return top_of(bed) > high_from; }
inline bool is_high(const PolyhedronBed&) { return false; }

/// As `solve`, but changes the gaps of the rows.
template <class Real>
SolveReport solve_changes(const SolveLimits& limits, const ExecutionContext& context,
                          SphereContacts<Real>& contacts, MotionColumns<Real>& motion);

}  // namespace grainsweep
