// Nematic order: do the axes of the grains point the same way, up to sign?
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/scene/bed.hpp"

namespace grainsweep {

struct NematicOrder {
  double order = 0.0;  ///< 1 if all are parallel, 0 in all directions alike, 1/4 all in one plane
  Vector director = Vector::Zero();  ///< unit; the direction they share, up to sign
};

/// Largest eigenvalue, and its eigenvector, of Q = mean over axes of (3 u u^T - 1) / 2 (de Gennes).
/// `axes` are unit vectors, all of one frame; NaN without any.
NematicOrder nematic_order(const std::vector<Vector>& axes);

/// The order of each axis of the frames in which the shapes of `grains` are written, of those of
/// them that turn.
std::array<double, 3> nematic_orders(const PolyhedronBed& bed,
                                     const std::vector<std::size_t>& grains);

}  // namespace grainsweep
