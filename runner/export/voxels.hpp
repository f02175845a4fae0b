// Beds as a grid of voxels.
#pragma once

#include <array>
#include <string>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// Where the middles of voxels lie: along each axis at (k + 1/2) size.
struct VoxelGrid {
  std::array<std::size_t, 3> count{};
  std::array<double, 3> size{};  ///< d
};

/// About `per_d` voxels per d; along x and y so that a whole number of them fills the box, and up
/// to the highest grain or just above it.
VoxelGrid voxel_grid(const StoredBed& bed, double per_d);

/// NRRD with its header attached: 0 where the middle of a voxel lies in no grain, otherwise the
/// size class of the grain, a byte each, x fastest. Grains reach through periodic sides; what lies
/// outside a tube is 255.
std::string voxels_nrrd(const ExportedBed& exported);

}  // namespace grainsweep
