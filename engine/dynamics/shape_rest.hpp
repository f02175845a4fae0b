// Whether a bed of grains that turn is at rest, and what forces it then carries; as
// engine/dynamics/rest.hpp does for spheres.
#pragma once

#include "engine/dynamics/rest.hpp"
#include "engine/dynamics/shape_step.hpp"

namespace grainsweep {

/// Gap up to which a point of contact counts as a constraint, d.
inline constexpr double constraint_gap = 1e-4;

/// How far from rest the bed is, after a step of length `dt`. Contacts are measured anew where the
/// grains are now. As `contacts` it counts the constraints of contacts that bear a force (a point
/// 1, a line 2, an area 3), which are isostatic at six for each grain less what slides freely: the
/// bed as one along each periodic axis, and grains alone on the floor, which also turn. Overlaps
/// are those of the deepest points of these contacts. Residual, kinetic energy and motion are left
/// at 0.
template <class Real>
RestReport certify(PolyhedronBed& bed, const ExecutionContext& context, double dt,
                   ShapeStepState<Real>& state);

/// Share of the grains' weight that the floor carried in the last step, of length `dt`.
template <class Real>
double carried_weight(const PolyhedronBed& bed, const ShapeStepState<Real>& state, double dt);

/// All pairs that bore a force in the last step, and sums of the forces on each grain.
template <class Real>
std::vector<PairForce> pair_forces(const PolyhedronBed& bed, const ShapeStepState<Real>& state,
                                   double dt);
template <class Real>
std::vector<double> force_sums(const PolyhedronBed& bed, const ShapeStepState<Real>& state,
                               double dt);

}  // namespace grainsweep
