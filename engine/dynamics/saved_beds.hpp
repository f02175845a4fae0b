// What a settling bed has to save to go on with the same bits; see engine/dynamics/saved_state.hpp.
#pragma once

#include "engine/dynamics/shape_step.hpp"
#include "engine/dynamics/step.hpp"

namespace grainsweep {

template <class Archive, class List>
void transfer_candidates(Archive& archive, List& candidates) {
  archive.value(candidates.reach);
  archive.value(candidates.largest_radius);
  archive.column(candidates.pairs);
  archive.column(candidates.built_at);
  archive.column(candidates.layer);
  archive.column(candidates.layers);
  archive.list(candidates.walls, [&](auto& near) { archive.column(near.grains); });
}

template <class Archive, class Rows>
void transfer_contacts(Archive& archive, Rows& contacts) {
  archive.column(contacts.rows);
  archive.value(contacts.pair_blocks);
  archive.column(contacts.walls);
  archive.column(contacts.shares.ranges);
  archive.column(contacts.shares.parts);
  archive.column(contacts.shares.grains);
  archive.column(contacts.impulse);
}

/// A bed of spheres after a step.
template <class Archive, class State>
void transfer_bed(Archive& archive, SphereBed& bed, State& state) {
  archive.column(bed.position);
  archive.column(bed.motion);
  archive.value(state.has_candidates);
  transfer_candidates(archive, state.candidates);
  transfer_contacts(archive, state.contacts);
}

/// Three numbers; Eigen's vectors are no plain bytes.
template <class Archive, class Three>
void transfer_vector(Archive& archive, Three& v) {
  archive.value(v.x());
  archive.value(v.y());
  archive.value(v.z());
}

template <class Archive, class Found>
void transfer_shape_contacts(Archive& archive, Found& found) {
  archive.list(found.contacts, [&](auto& contact) {
    archive.value(contact.a);
    archive.value(contact.b);
    archive.value(contact.kind);
    transfer_vector(archive, contact.normal);
    archive.value(contact.first);
    archive.value(contact.count);
  });
  archive.list(found.points, [&](auto& point) {
    transfer_vector(archive, point.position);
    archive.value(point.gap);
  });
}

/// A bed of grains that turn after a step.
template <class Archive, class State>
void transfer_bed(Archive& archive, PolyhedronBed& bed, State& state) {
  archive.column(bed.position);
  archive.column(bed.orientation);
  archive.column(bed.motion);
  archive.list(bed.spin, [&](auto& spin) { transfer_vector(archive, spin); });
  archive.value(state.search.has_candidates);
  transfer_candidates(archive, state.search.candidates);
  archive.list(state.search.memory, [&](auto& memory) {
    transfer_vector(archive, memory.axis);
    archive.value(memory.simplex);
  });
  transfer_shape_contacts(archive, state.contacts);
  archive.column(state.places.first);
  archive.column(state.rows.impulse);
}

}  // namespace grainsweep
