// Contacts under the names of their two sides, so that tests need not know rows and lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "engine/rows/sphere_contacts.hpp"

namespace grainsweep::testing {

/// Grains a < b, or grain a and `wall_name` of a wall.
using ContactName = std::pair<std::int32_t, std::int32_t>;

/// Name of wall k as walls_of(box) counts them; 0 is the floor.
inline std::int32_t wall_name(const SphereBed& bed, std::size_t k) {
  return bed.wall() + static_cast<std::int32_t>(k);
}

/// Name of the wall that owns `block`; -1 if none does.
template <class Real>
std::int32_t wall_of_block(const SphereBed& bed, const SphereContacts<Real>& contacts,
                           std::size_t block) {
  for (std::size_t k = 0; k < contacts.walls.size(); ++k) {
    const WallRows& rows = contacts.walls[k];
    if (rows.first <= block && block < rows.first + rows.blocks) {
      return wall_name(bed, k);
    }
  }
  return -1;
}

/// Calls visit(row block, lane, impulse) for each row that stands for a pair or a wall.
template <class Real, class Visit>
void visit_rows(const SphereBed& bed, const SphereContacts<Real>& contacts, Visit visit) {
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      if (!bed.is_void(contacts.rows[block].a(lane))) {
        visit(contacts.rows[block], lane, contacts.impulse[block * block_width + lane]);
      }
    }
  }
}

/// Calls visit(name, block, lane) for every row that is not void.
template <class Real, class Visit>
void visit_named(const SphereBed& bed, const SphereContacts<Real>& contacts, Visit visit) {
  for (std::size_t block = 0; block < contacts.rows.size(); ++block) {
    for (std::size_t lane = 0; lane < block_width; ++lane) {
      const RowBlock<Real>& r = contacts.rows[block];
      if (!bed.is_void(r.a(lane))) {
        const bool is_pair = block < contacts.pair_blocks;
        visit(ContactName{r.a(lane), is_pair ? r.b(lane) : wall_of_block(bed, contacts, block)},
              block, lane);
      }
    }
  }
}

/// Impulse of every contact that has a row.
template <class Real>
std::map<ContactName, Real> impulses_of(const SphereBed& bed,
                                        const SphereContacts<Real>& contacts) {
  std::map<ContactName, Real> impulses;
  visit_named(bed, contacts, [&](const ContactName& name, std::size_t block, std::size_t lane) {
    impulses[name] = contacts.impulse[block * block_width + lane];
  });
  return impulses;
}

/// Gives the contacts named their impulses; the others keep what they have.
template <class Real>
void set_impulses(const SphereBed& bed, const std::map<ContactName, Real>& impulses,
                  SphereContacts<Real>& contacts) {
  visit_named(bed, contacts, [&](const ContactName& name, std::size_t block, std::size_t lane) {
    const auto found = impulses.find(name);
    if (found != impulses.end()) {
      contacts.impulse[block * block_width + lane] = found->second;
    }
  });
}

/// All contacts of a bed with a gap below `reach`, laid out and measured.
template <class Real>
SphereContacts<Real> contacts_of(SphereBed& bed, double reach, const Kernels& kernels) {
  Candidates candidates;
  SphereContacts<Real> contacts;
  wrap(bed);
  find_candidates({bed, bed.position}, reach, kernels, candidates);
  lay_out(bed, candidates, contacts);
  update_gaps(bed, kernels, 1.0, contacts);
  return contacts;
}

}  // namespace grainsweep::testing
