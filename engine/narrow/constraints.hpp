// What a contact of two grains with corners amounts to: a point, a line or an area.
#pragma once

#include <array>

#include "engine/narrow/manifold.hpp"

namespace grainsweep {

/// The points that say where a contact is: one for a point (a vertex, or crossing edges), two for a
/// line (an edge on a face), three for an area (face on face); none if no gap is below `tolerance`.
/// They are the first, the farthest from it, and the farthest from both.
struct ConstraintPoints {
  std::array<const ContactPoint*, 3> point{};
  int count = 0;
};
ConstraintPoints constraint_points(const ContactPoint* points, std::size_t count, double tolerance);

/// How many constraints a contact is.
inline int constraints_of(const ContactPoint* points, std::size_t count, double tolerance) {
  return constraint_points(points, count, tolerance).count;
}

}  // namespace grainsweep
