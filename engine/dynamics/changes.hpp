// A step's impulses as changes of the last step's.
//
// At the foot of a high bed contacts push with hundreds of weights, and f32 keeps seven digits of
// that: sweeps, and momentum more so, gather what is rounded away until a bed of 100 d misses
// balance by hundredths of a weight, which taps it and keeps it from being found at rest. From step
// to step impulses change by far less than they are. So the motion that the last step's impulses
// give is found once in f64, and what it leaves of each gap; the sweeps then solve for the changes
// of impulses and motion alone, in f32 with nearly the digits of f64.
#pragma once

#include "engine/dynamics/columns.hpp"
#include "engine/dynamics/solve.hpp"

namespace grainsweep {

/// Lower beds come to rest as soon without, d: f32 leaves 1e-4 m g for every d of height.
inline constexpr double high_from = 100.0;

/// Whether steps in f32 solve for changes. Of polyhedra they do not.
inline bool is_high(const SphereBed& bed) { return top_of(bed) > high_from; }
inline bool is_high(const PolyhedronBed&) { return false; }

/// As `solve`. Leaves the gaps of the rows changed.
template <class Real>
SolveReport solve_changes(const SolveLimits& limits, const ExecutionContext& context,
                          SphereContacts<Real>& contacts, MotionColumns<Real>& motion);

}  // namespace grainsweep
