// Flat regions with holes, as triangles between the corners that they have.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace grainsweep {

/// Numbers of corners, in their order along an edge or around a region.
using Loop = std::vector<std::int32_t>;

/// The region of a plane that lies left of all its loops, seen against `normal`: outer ones turn
/// counter-clockwise, holes clockwise. Loops neither cross nor touch. Adds no corner and leaves out
/// none, so that regions that share an edge still do. Throws std::logic_error if the loops are not
/// like that.
std::vector<Loop> triangles_of(const std::vector<Eigen::Vector3d>& corners,
                               const Eigen::Vector3d& normal, const std::vector<Loop>& loops);

}  // namespace grainsweep
