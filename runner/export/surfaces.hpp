// Closed surfaces of the grains of a bed, and of what contains it. Lengths in d.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "runner/export/exported_bed.hpp"

namespace grainsweep {

/// A closed surface of flat faces, each edge of which two faces share.
struct Surface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::int32_t>> faces;  ///< counter-clockwise seen from outside
};

/// Vertex k.
inline const Eigen::Vector3d& corner(const Surface& surface, std::int32_t k) {
  return surface.vertices[static_cast<std::size_t>(k)];
}

/// A sphere of radius 1 about the origin: an icosahedron with each triangle divided in four
/// `divisions` times; all corners lie on the sphere.
Surface unit_ball(int divisions);

/// A mesh as it is drawn: unchanged, or for a sphere the triangles of unit_ball.
Mesh drawn_mesh(const Mesh& mesh, int divisions);

/// The part of a convex surface where normal . x <= offset; empty if there is none.
Surface cut_off(const Surface& surface, const Eigen::Vector3d& normal, double offset);

/// The same without the corners that belong to no face.
Surface compact(const Surface& surface);

/// A grain, or an image of it, or several that necks join.
struct GrainSurface {
  std::size_t grain = 0;   ///< or the first one of those joined
  std::size_t grains = 0;  ///< and images of them
  Surface surface;
};

/// The surfaces of all grains about their centres, untreated; those of spheres have smaller faces
/// where their contacts will be cut.
std::vector<Surface> whole_surfaces(const ExportedBed& exported);

/// The surfaces of all grains with the treatment of their contacts and, where asked for, the images
/// of those that cross periodic sides.
std::vector<GrainSurface> grain_surfaces(const ExportedBed& exported);

/// The box up to that height, or the tube as a prism around it.
Surface container_surface(const Box& box, double height);

/// What each face of that surface is, for meshers to tell boundaries by: container_walls,
/// container_periodic_x or _y, container_floor, container_top.
std::vector<std::string> container_parts(const Box& box);

}  // namespace grainsweep
