// The grains of stored packings in formats that other programs read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "runner/store/states.hpp"

namespace grainsweep {

enum class ExportFormat {
  csv,  ///< header and one row per grain
  xyz,  ///< extended XYZ, for OVITO and ASE
  vtp,  ///< VTK XML PolyData, for ParaView and VTK
};

/// "csv", "xyz", "vtp": also the file's ending.
const char* name_of(ExportFormat format);
std::optional<ExportFormat> export_format(std::string_view name);

/// x, y, z, radius (d), force (m g), coordination: a grain per line. Of grains that are no spheres
/// also qx, qy, qz, qw, the unit quaternion from the shape's frame to the box's.
std::string grains_csv(const StoredBed& bed);

/// The box as Lattice (its height is the bed's), periodic axes as pbc, a grain per line with
/// species, pos, radius (d), coordination, force (m g), and orientation (x, y, z, w) of grains that
/// are no spheres.
std::string grains_xyz(const StoredBed& bed);

/// Spheres as points with the arrays radius (d), coordination, force (m g); other grains as the
/// polygons of their faces, each with the arrays grain (from 0), size (d), coordination, force of
/// its grain. In text.
std::string grains_vtp(const StoredBed& bed);

/// The vertices of a grain that is no sphere, in the frame of the box, d.
std::vector<Eigen::Vector3d> vertices_in_box(const StoredBed& bed, std::size_t grain);

/// The bed in `format`.
std::string grains_text(const StoredBed& bed, ExportFormat format);

}  // namespace grainsweep
