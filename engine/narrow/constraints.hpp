// What a contact of two grains with corners amounts to: a point, a line or an area.
#pragma once

#include "engine/narrow/manifold.hpp"

namespace grainsweep {

/// How many constraints a contact is: 1 of a point (a vertex, or crossing edges), 2 of a line (an
/// edge on a face), 3 of an area (face on face); 0 if no gap is below `tolerance`.
int constraints_of(const ContactPoint* points, std::size_t count, double tolerance);

}  // namespace grainsweep
