// Spares and late rows: candidates that are not rows, and what becomes of them when they come near.
#pragma once

#include "engine/rows/sphere_contacts.hpp"

namespace grainsweep {

/// Measures normal and gap of blocks of pairs; see `update_gaps`. `sunk` is memory.
template <class Real>
double measure_blocks(const SphereBed& bed, const ExecutionContext& context, double correction,
                      RowBlock<Real>* rows, std::size_t blocks, std::vector<double>& sunk);

/// Sorts all candidate pairs into those with a gap below `reach`, `contacts.layout.near`, and
/// spares, both in the order of the candidates. A pair that its subdomain may not hold is a spare,
/// too: it lay further apart than it would if it were near now. The grains must have been divided.
template <class Real>
void part_spares(double reach, const ExecutionContext& context, const SphereBed& bed,
                 const Candidates& candidates, SphereContacts<Real>& contacts);

/// After candidates were added, and grains have moved: makes rows of those with walls and of spares
/// with a gap below `near`. Returns false if there is no room for all: then some are not rows yet,
/// and all have to be laid out anew.
template <class Real>
bool add_near(double near, const ExecutionContext& context, const SphereBed& bed,
              const Candidates& candidates, SphereContacts<Real>& contacts);

}  // namespace grainsweep
