// Memory of settling, kept from one packing to the next.
//
// Small beds are made in milliseconds, thousands on each core. What a packing leaves in here is
// memory, not values: a packing has the same bits with a fresh workspace and with a used one.
#pragma once

#include <tuple>

#include "engine/dynamics/step.hpp"

namespace grainsweep {

/// For one packing at a time.
struct Workspace {
  std::tuple<StepState<Sphere, float>, StepState<Sphere, double>, StepState<Polyhedron, float>,
             StepState<Polyhedron, double>>
      states;
  /// Closed contacts of a bed, as the static balance solves them.
  std::tuple<StepState<Sphere, double>, StepState<Polyhedron, double>> closed;
};

/// Forgets the last packing but keeps its memory.
template <class Real>
void forget(SphereContacts<Real>& contacts) {
  contacts.rows.clear();
  contacts.impulse.clear();
  contacts.changed_from.clear();  // filled where a solve ran out of memory
  contacts.shares.clear();
  contacts.walls.clear();
  contacts.pair_blocks = 0;
  contacts.first_round = 0;
  contacts.spares.blocks.clear();
  contacts.spares.count = 0;
}
template <class Real>
void forget(PolyhedronContacts<Real>& contacts) {
  contacts.found_parts = 0;
  forget_pairs(contacts);
  contacts.impulse.clear();
}
template <class Kind, class Real>
void forget(StepState<Kind, Real>& state) {
  state.candidates.is_listed = false;
  state.candidates.is_indexed = false;
  forget(state.contacts);
}

}  // namespace grainsweep
