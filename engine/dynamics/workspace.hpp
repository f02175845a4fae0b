// Memory of settling, kept from one packing to the next.
//
// Small beds are made in milliseconds, thousands on each core. What a packing leaves in here is
// room, no value: a packing has the same bits with a fresh workspace and with a used one.
#pragma once

#include "engine/dynamics/shape_step.hpp"
#include "engine/dynamics/step.hpp"

namespace grainsweep {

/// For one packing at a time.
struct Workspace {
  StepState<float> f32;
  StepState<double> f64;
  ShapeStepState<float> turning_f32;
  ShapeStepState<double> turning_f64;
};

/// Forgets the last packing but keeps its memory.
template <class Real>
void forget(StepState<Real>& state) {
  state.has_candidates = false;
  state.contacts.rows.clear();
  state.contacts.impulse.clear();
  state.contacts.shares.clear();
  state.contacts.walls.clear();
  state.contacts.pair_blocks = 0;
}
template <class Real>
void forget(ShapeStepState<Real>& state) {
  state.search.has_candidates = false;
  state.contacts.contacts.clear();
  state.contacts.points.clear();
  state.places.first.clear();
  state.rows.impulse.clear();
}

}  // namespace grainsweep
