// One step of the heavy-ball displacement protocol for grains that turn.
//
// As engine/dynamics/step.hpp, with angle vectors beside displacements: without contacts a grain
// would move by alpha u_last + g dt^2 and turn by alpha times what keeps its angular momentum, each
// clamped; the contacts change that as little as keeps all gaps open, to first order in the angles.
#pragma once

#include "engine/dynamics/step.hpp"
#include "engine/narrow/shape_contacts.hpp"
#include "engine/rows/lever_layout.hpp"
#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Everything that steps need besides the bed. After a step `contacts`, `places` and `rows` hold
/// the contacts it found, before the grains moved, and their impulses.
template <class Real>
struct ShapeStepState {
  ShapeSearch search;
  ShapeContacts contacts;
  LeverPlaces places;
  LeverColumns<Real> rows;
  CarriedPoints carried;
  MotionColumns<Real> motion;
};

/// Contacts of a step of length `dt` are those with a gap below `near`, d.
TouchSettings touch_settings(double near, double dt);

/// A step. `largest_motion` of the report counts the way that a turn takes a point at the
/// circumradius; the kinetic energy counts turning.
template <class Real>
StepReport step(const StepSettings& settings, const ExecutionContext& context, PolyhedronBed& bed,
                ShapeStepState<Real>& state);

/// Velocities stay as they are when the next step is `ratio` times as long as the last one: motions
/// scale with it, impulses with its square.
template <class Real>
void change_step(double ratio, PolyhedronBed& bed, ShapeStepState<Real>& state);

/// Impulse of point j of contact k, in masses times d.
template <class Real>
double impulse_of(const ShapeStepState<Real>& state, std::size_t k, std::size_t j) {
  return static_cast<double>(state.rows.impulse[state.places.first[k] + j * block_width]);
}

}  // namespace grainsweep
