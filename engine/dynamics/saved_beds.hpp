// What a settling bed has to save to go on with the same bits; see engine/saved_state.hpp.
#pragma once

#include "engine/dynamics/step.hpp"

namespace grainsweep {

template <class Archive, class List>
void transfer_candidates(Archive& archive, List& candidates) {
  archive.value(candidates.is_listed);
  archive.value(candidates.reach);
  archive.value(candidates.slack);
  archive.value(candidates.lookup);
  archive.value(candidates.searched);
  archive.column(candidates.pairs);
  archive.column(candidates.built_at);
  archive.column(candidates.members);
  archive.list(candidates.walls, [&](auto& near) { archive.column(near); });
  archive.list(candidates.levels, [&](auto& level) {
    archive.value(level.largest_radius);
    archive.value(level.less);
    archive.value(level.cells);
  });
}

/// Three numbers; Eigen's vectors are no plain bytes.
template <class Archive, class Three>
void transfer_vector(Archive& archive, Three& v) {
  archive.value(v.x());
  archive.value(v.y());
  archive.value(v.z());
}

template <class Archive>
void transfer_kind(Archive&, SphereBed&) {}
template <class Archive>
void transfer_kind(Archive& archive, PolyhedronBed& bed) {
  archive.column(bed.orientation);
  archive.list(bed.spin, [&](auto& spin) { transfer_vector(archive, spin); });
}

template <class Archive, class Real>
void transfer_contacts(Archive& archive, SphereContacts<Real>& contacts) {
  archive.column(contacts.rows);
  archive.value(contacts.pair_blocks);
  archive.value(contacts.first_round);
  archive.column(contacts.walls);
  archive.column(contacts.shares.ranges);
  archive.column(contacts.shares.parts);
  archive.column(contacts.shares.grains);
  archive.column(contacts.impulse);
  archive.column(contacts.spares.blocks);
  archive.value(contacts.spares.count);
  archive.column(contacts.late);
  archive.value(contacts.taken_pairs);
  archive.column(contacts.taken_at_walls);
  archive.value(contacts.layout.subdomains.count);
  archive.value(contacts.layout.subdomains.is_ring);
  archive.column(contacts.layout.subdomains.slab);
  archive.column(contacts.layout.subdomains.of_slab);
  archive.list(contacts.layout.wall_ranges, [&](auto& ranges) { archive.column(ranges); });
}

template <class Archive, class Subdomains>
void transfer_subdomains(Archive& archive, Subdomains& subdomains) {
  archive.value(subdomains.count);
  archive.value(subdomains.is_ring);
  archive.column(subdomains.pairs);
  archive.column(subdomains.begin);
  archive.column(subdomains.grains);
  archive.column(subdomains.first_grain);
  archive.list(subdomains.near_walls, [&](auto& grains) { archive.column(grains); });
}

template <class Archive, class Part>
void transfer_part(Archive& archive, Part& part) {
  archive.list(part.found.contacts, [&](auto& contact) {
    archive.value(contact.a);
    archive.value(contact.b);
    archive.value(contact.kind);
    archive.value(contact.edges);
    transfer_vector(archive, contact.normal);
    archive.value(contact.first);
    archive.value(contact.count);
  });
  archive.list(part.found.points, [&](auto& point) {
    transfer_vector(archive, point.position);
    archive.value(point.gap);
  });
  archive.column(part.first);
}

template <class Archive, class Real>
void transfer_contacts(Archive& archive, PolyhedronContacts<Real>& contacts) {
  transfer_subdomains(archive, contacts.subdomains);
  archive.list(contacts.memory, [&](auto& memory) {
    transfer_vector(archive, memory.axis);
    archive.value(memory.touched);
    archive.value(memory.candidates);
  });
  archive.column(contacts.far_until);
  archive.column(contacts.travel.position);
  archive.column(contacts.travel.orientation);
  archive.column(contacts.travel.way);
  archive.value(contacts.found_parts);
  archive.list(contacts.parts, [&](auto& part) { transfer_part(archive, part); });
  archive.column(contacts.impulse);
}

/// A bed after a step.
template <class Archive, class Kind, class Real>
void transfer_bed(Archive& archive, Bed<Kind>& bed, StepState<Kind, Real>& state) {
  archive.column(bed.position);
  archive.column(bed.motion);
  archive.column(bed.asleep);
  archive.value(bed.first_awake);
  archive.column(bed.lightness);
  transfer_kind(archive, bed);
  transfer_candidates(archive, state.candidates);
  transfer_contacts(archive, state.contacts);
}

}  // namespace grainsweep
