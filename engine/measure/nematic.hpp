// Nematic order: do the axes of the grains point the same way, up to sign?
#pragma once

#include <vector>

#include "engine/shape/convex_shape.hpp"

namespace grainsweep {

struct NematicOrder {
  double order = 0.0;  ///< 1 if all are parallel, 0 in all directions alike, 1/4 all in one plane
  Vector director = Vector::Zero();  ///< unit; the direction they share, up to sign
};

/// Largest eigenvalue, and its eigenvector, of Q = mean over axes of (3 u u^T - 1) / 2 (de Gennes).
/// `axes` are unit vectors, all of one frame; NaN without any.
NematicOrder nematic_order(const std::vector<Vector>& axes);

}  // namespace grainsweep
