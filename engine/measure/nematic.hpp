// Nematic order: do the axes of the grains point the same way, up to sign?
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/scene/bed.hpp"

namespace grainsweep {

/// Largest eigenvalue of Q = mean over axes of (3 u u^T - 1) / 2 (de Gennes): 1 if all are
/// parallel, 0 in all directions alike, 1/4 all in one plane. `axes` are unit vectors, all of one
/// frame; NaN without any.
double nematic_order(const std::vector<Vector>& axes);

/// The order of each axis of the frames in which the shapes of `grains` are written, over those
/// grains that can turn.
std::array<double, 3> nematic_orders(const PolyhedronBed& bed,
                                     const std::vector<std::size_t>& grains);

}  // namespace grainsweep
