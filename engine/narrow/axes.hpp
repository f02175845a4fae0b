// What the searches for separating axes share.
#pragma once

#include "engine/narrow/separating_axes.hpp"

namespace grainsweep {

// Sine of the angle below which two edges are parallel: their cross product is rounding.
inline constexpr double parallel = 1e-14;

inline const Vector& face_normal(const ConvexShape& shape, std::int32_t k) {
  return shape.faces[static_cast<std::size_t>(k)].normal;
}

/// Axis along the cross product of two edges, at right angles to both up to rounding however small
/// their angle is: only the part of `v` at right angles to `u` is crossed. Zero if they are
/// parallel.
inline Vector across(const Vector& u, const Vector& v) {
  const Vector n = u.cross(v - u.dot(v) * u);
  const double length = n.norm();
  return length > parallel ? Vector(n / length) : Vector(Vector::Zero());
}

/// The best axes of any two hulls; see separating_axes.
ContactAxes hull_axes(const ShapePair& pair, const Vector& guess, AxisCandidates& candidates,
                      AxisColumns& columns);

}  // namespace grainsweep
